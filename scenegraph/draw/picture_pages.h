#pragma once
/// The pictures that buildings wear on the GPU: squares in the pages of one array, with all their levels, each as large
/// as it was needed when it came. What is seen and not held is asked for, and drawn in its mean colour until it comes;
/// what was not seen for longest makes room, and where all that is seen needs more than there is, all of it is coarser.
///   PicturePages pages(scene.pictures, most_bytes);
///   pages.begin(); see(pages, scene, meshes.buildings, detail); pages.end();               // each picture
///   for (const PictureWanted& w : pages.wanted()) ...make picture_square(..., w.side)...; pages.add(w, square);
///   pages.bind();                                                                          // for worn.glsl
#include <optional>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "scenegraph/draw/city_pieces.h"
#include "scenegraph/draw/square_room.h"
#include "scenegraph/pictures.h"

namespace manzana::draw {

namespace glsl {
using glm::vec4;
using uvec4 = glm::uvec4;
#include "scenegraph/draw/shaders/worn_layout.glsl"
}  // namespace glsl

class PicturePages {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;

  PicturePages(const Pictures& pictures, std::size_t most_bytes);
  void begin();
  /// In sight, the longer side of the whole picture about so many pixels.
  void see(std::uint32_t picture, double pixels);
  void end();
  /// Of what is in sight: not held, or coarser than a pixel.
  std::span<const PictureWanted> wanted() const { return wanted_; }
  /// As fine as there is room for; if that is less than was wanted, it is not wanted for a while. False: it is there
  /// already, or there is no room at all.
  bool add(const PictureWanted& wanted, const PictureSquare& square);
  void bind() const;
  std::size_t device_bytes() const;
  bool holds(std::uint32_t picture) const { return rows_[picture].held.has_value(); }

 private:
  struct Row {
    std::uint32_t full = 1;  ///< side
    double share = 1;        ///< of the picture's side that is worn, the larger one
    Vec4 part{0, 0, 1, 1};   ///< WornData
    std::vector<std::uint32_t> textures;
    std::optional<Square> held;
    std::uint32_t need = 0;  ///< side, of this picture
    std::uint64_t seen = 0, refused = 0;
  };
  std::optional<Square> place(std::uint32_t side);
  bool grow();
  bool make_room();
  void release(Row& row);
  void shrink(Row& row);
  void tell(const Row& row) const;

  std::vector<Row> rows_;  ///< a picture each
  std::vector<std::uint32_t> in_sight_;
  std::vector<PictureWanted> wanted_;
  std::vector<Texture> textures_;
  SquareRoom room_;
  std::uint32_t most_pages_;
  std::uint64_t now_ = 0;
  gl::Texture pages_;
  gl::Buffer worn_;  ///< a row a texture
};

/// What the buildings of pieces in sight wear, each by how far away it is.
void see(PicturePages& pages, const Scene& scene, const LayerPieces& buildings, const MeshDetail& detail);

}  // namespace manzana::draw
