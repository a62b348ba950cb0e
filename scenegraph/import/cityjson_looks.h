#pragma once
/// What `appearance` says of surfaces: a colour of each, the material's, or the mean of the part of a picture that it
/// wears; and that part. Pictures lie in the file's folder or below it; each is decoded once, at the end, one at a
/// time, and those that can be are kept as files, not as pixels.
///   const Appearance looks = appearance_of(document, issues);
///   std::vector<std::uint32_t> colours = materials_of(geometry, looks);
///   worn.add(geometry, looks, first);                    // its surfaces are `first` and those that follow
///   worn.paint(folder, issues, pictures, [&](const OnPicture& part, std::uint32_t rgb, std::uint32_t texture) { ...
///   });
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>

#include "foliage/import/plant_image.h"
#include "scenegraph/import/cityjson_geometry.h"
#include "scenegraph/import/features.h"

namespace manzana::cityjson {

/// A surface on a picture: u to the right and v up, both 0 to 1; its rings, of which inner ones are holes.
struct OnPicture {
  std::uint32_t surface = 0;
  Wrap wrap = Wrap::repeat;
  std::vector<std::vector<Vec2d>> rings;
  std::uint32_t border = 0;  ///< Texture::border
};

/// 0xRRGGBB: the mean of linear light over the rings, weighted by alpha, at no more than about 32 x 32 places; kNone
/// where all is transparent, or a place is not finite or farther than 1000 pictures away.
std::uint32_t mean_colour(const foliage::Picture& picture, const OnPicture& part);

/// Of a document, or of a feature of a sequence.
struct Appearance {
  struct Texture {
    std::string image;
    Wrap wrap = Wrap::repeat;
    std::uint32_t border = 0;  ///< Texture::border
  };
  std::vector<std::uint32_t> materials;  ///< 0xRRGGBB; kNone
  std::vector<Texture> textures;
  std::vector<Vec2d> places;  ///< vertices-texture
  std::string material_theme, texture_theme;
};
/// Empty where the document has none; materials that are none are listed.
Appearance appearance_of(const Json& document, std::vector<Issue>& issues);

/// A row a face of surfaces_of: 0xRRGGBB, kNone. Of several themes the default's, else the first that says something.
std::vector<std::uint32_t> materials_of(const Json& geometry, const Appearance& looks);

/// Surfaces by the picture that they wear.
class Worn {
 public:
  /// Faces of the geometry that wear one, by themes likewise; the first is number `first_surface`. Whether any does.
  bool add(const Json& geometry, const Appearance& looks, std::uint32_t first_surface);
  /// The number of the texture in `pictures`, from 1, where a surface's picture is added.
  using Take = std::function<void(const OnPicture& part, std::uint32_t rgb, std::uint32_t texture)>;
  /// All that wear pictures in the folder or below it; without a folder there are none. Only those that are decoded are
  /// added; what cannot be read is listed, once a picture.
  void paint(const std::optional<std::filesystem::path>& folder, std::vector<Issue>& issues, Pictures& pictures,
             const Take& take) const;

 private:
  std::map<std::string, std::vector<OnPicture>> by_picture_;  ///< by its name without detours
};

/// The face wears the part, if the rings of both have the same number of corners. `number`: Surfaces::number.
void wear(ConstructionFeature& shape, std::uint32_t face, std::span<const std::uint32_t> number, const OnPicture& part,
          std::uint32_t texture);

}  // namespace manzana::cityjson
