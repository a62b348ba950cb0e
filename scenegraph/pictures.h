#pragma once
/// Pictures that surfaces wear: where their bytes lie, as PNG or JPEG. None is decoded here: what draws asks for one
/// when a surface that wears it is in sight, as large as it is seen (scenegraph/import/picture_square.h,
/// scenegraph/draw/picture_maker.h).
///   const Texture& worn = scene.pictures.textures[mesh.textures[vertex] - 1];
///   const EncodedPicture& picture = scene.pictures.encoded[worn.picture];
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenegraph/column.h"
#include "scenegraph/ground_photo.h"

namespace manzana {

/// How a picture goes on beyond its edges.  [CityJSON 2.0, 6.2; OGC CityGML 2.0, 9.4]
enum class Wrap : std::uint32_t {
  none,    ///< there is nothing: the surface's own colour
  repeat,  ///< `wrap`
  mirror,
  clamp,
  border,  ///< a colour
  count
};

struct Texture {
  std::uint32_t picture = 0;  ///< of Pictures::encoded
  Wrap wrap = Wrap::repeat;
  std::uint32_t border = 0;  ///< sRGB red | green << 8 | blue << 16 | alpha << 24
  bool operator==(const Texture&) const = default;
};

/// Pixels of a picture, from its left and its top.
struct PicturePart {
  std::uint32_t left = 0, top = 0, width = 0, height = 0;
  bool operator==(const PicturePart&) const = default;
};

/// In a file, `name`, in the folder or below it and nowhere else; or in `bytes`, where these are not empty.
struct EncodedPicture {
  std::filesystem::path folder;
  std::string name;
  Column<std::byte> bytes;
  std::uint32_t width = 0, height = 0;
  PicturePart worn = {};  ///< the part that is worn: no other is drawn
};

struct Pictures {
  std::vector<EncodedPicture> encoded;
  std::vector<Texture> textures;  ///< what CityMesh::textures counts from 1
};

/// What is worn of a picture as what draws has it: stretched to a square whose side is a power of two, from full size
/// down to one texel. Texels are as GroundPhoto's: multiplied by alpha; rows from the bottom.
using PictureSquare = std::vector<GroundPhoto::Level>;

/// More than this a picture's square never has a side.
inline constexpr std::uint32_t kLargestSquare = 2048;
/// About as many texels as what is worn of the picture has: a power of two, at most kLargestSquare.
std::uint32_t side_of(const EncodedPicture& picture);

/// The others follow; what is to be added to numbers of their textures that are not 0.
std::uint32_t join(Pictures& into, Pictures more);

}  // namespace manzana
