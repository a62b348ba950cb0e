#pragma once
/// The tree of tiles, as it follows from the BqR-Tree.
///   std::vector<Tile> tiles = tile_tree(scene);                     // tiles[0] is the root, parents precede children
#include <vector>

#include "scenegraph/scene.h"

namespace manzana {

struct Tile {
  BlockFrame frame;
  double error_m = 0;                 ///< what may be wrong in it; not more than in its parent
  bool leaf = false;                  ///< all of one block
  std::vector<std::uint32_t> blocks;  ///< below it, that hold objects
  std::vector<std::uint32_t> children;
};

/// What may be wrong in the leaves' trees, metres: cards of that size stand for leaves.
inline constexpr double kLeafError = 0.5;

/// Blocks without objects have none. Empty for a scene without objects.
std::vector<Tile> tile_tree(const Scene& scene);

}  // namespace manzana
