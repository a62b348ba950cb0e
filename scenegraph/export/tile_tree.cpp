#include "scenegraph/export/tile_tree.h"

#include <algorithm>

namespace manzana {
namespace {

// A node may be wrong by this share of its radius. At 16 pixels of 1080 over 60 degrees, which is what viewers take
// unless told otherwise, a tile is then refined from a distance of twice its radius on.
constexpr double kErrorOfRadius = 1.0 / 30;

class Builder {
 public:
  explicit Builder(const Scene& scene) : scene_(scene), tree_(scene.tree) {}

  std::vector<Tile> run() {
    if (tree_.objects() > 0) add_node(tree_.root);
    return std::move(tiles_);
  }

 private:
  std::uint32_t add_node(std::uint32_t index) {
    const auto at = static_cast<std::uint32_t>(tiles_.size());
    tiles_.emplace_back();
    Tile tile;
    culling::BoxD box;
    const culling::BqrNode& node = tree_.nodes[index];
    for (std::uint32_t lane = 0; lane < culling::kLanes; ++lane) {
      if ((node.lanes >> lane & 1U) == 0 || node.first[lane] == node.last[lane]) continue;
      box = merge(box, lane_box(node, lane));
      const bool block = (node.blocks >> lane & 1U) != 0;
      const std::uint32_t child = block ? add_block(node.first_block[lane]) : add_node(node.child[lane]);
      tile.children.push_back(child);
      tile.blocks.insert(tile.blocks.end(), tiles_[child].blocks.begin(), tiles_[child].blocks.end());
      tile.error_m = std::max(tile.error_m, tiles_[child].error_m);
    }
    const Vec2d half = Vec2d(box.max - box.min) / 2.0;
    tile.error_m = std::max({tile.error_m, kErrorOfRadius * glm::length(half), 2 * kLeafError});
    tile.frame = block_frame(scene_.frame, Vec2d(center(box) + tree_.origin));
    tiles_[at] = std::move(tile);
    return at;
  }

  std::uint32_t add_block(std::uint32_t block) {
    const culling::ObjectRun trees = scene_.trees.table.rows(tree_.block_objects[block]);
    Tile& tile = tiles_.emplace_back();
    tile.frame = scene_.blocks[block];
    tile.error_m = trees.first == trees.last ? 0 : kLeafError;
    tile.leaf = true;
    tile.blocks = {block};
    return static_cast<std::uint32_t>(tiles_.size() - 1);
  }

  const Scene& scene_;
  const culling::BqrTree& tree_;
  std::vector<Tile> tiles_;
};

}  // namespace

std::vector<Tile> tile_tree(const Scene& scene) { return Builder(scene).run(); }

}  // namespace manzana
