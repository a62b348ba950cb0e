#pragma once
/// A plant's finest quads in pieces that lie together, for drawing only those that can be in a picture.
#include "foliage/parallel_view.h"

namespace manzana::foliage {

struct CellPiece {
  Run quads;                ///< of PreparedPlant::leaves, or bark
  std::uint32_t cell = 0;   ///< as many as there are cells: bark
  Vec3 middle{0}, half{0};  ///< the box along the axes round its corners
};

/// The finest bark, then each cell with quads, in their order.
std::vector<CellPiece> pieces_of(const PreparedPlant& plant);

/// Pixels [low, high) of a picture.
struct PixelBox {
  glm::ivec2 low{0}, high{0};
  bool empty() const { return low.x >= high.x || low.y >= high.y; }
};

/// All that the piece can touch, and a pixel's width more.
PixelBox pixels_of(const CellPiece& piece, const ParallelView& view);

}  // namespace manzana::foliage
