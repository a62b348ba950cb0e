#include "scenegraph/draw/select_trees.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace manzana::draw {
namespace {

// The crown's ball: about the middle of the tree, round all of it.
std::size_t level_of(const TreeInstance& tree, const Rows& block, double focal_px, const foliage::PlantModel& model) {
  const float half = tree.height_m / 2;
  const auto radius = static_cast<double>(std::hypot(half, tree.crown_radius_m));
  const Vec3 middle = placed(block, tree.position + Vec3(0, 0, half));
  const double distance = static_cast<double>(glm::length(middle));
  return foliage::select_level(model, culling::projected_radius(radius, distance, focal_px));
}

// Scaled by (r, r, h), turned by yaw, stood in its block.
Instance place(const TreeInstance& tree, const Rows& block) {
  const float r = tree.crown_radius_m, h = tree.height_m;
  const float c = r * std::cos(tree.yaw), s = r * std::sin(tree.yaw);
  const Vec3 foot = placed(block, tree.position);
  Instance instance;
  for (int i = 0; i < 3; ++i) {
    const Vec4& row = block[static_cast<std::size_t>(i)];
    instance.rows[static_cast<std::size_t>(i)] = {c * row.x + s * row.y, c * row.y - s * row.x, h * row.z, foot[i]};
  }
  const auto bark_layer = 2 * static_cast<std::size_t>(tree.kind);
  instance.extra = {1 / r, 1 / h, static_cast<float>(tree.tint) / 255, static_cast<float>(bark_layer)};
  return instance;
}

}  // namespace

TreeSelection::TreeSelection(std::size_t trees, std::span<const foliage::PlantModel> all) : models(all), bins(0) {
  std::size_t meshes = 0;
  for (const foliage::PlantModel& model : models) {
    first_mesh.push_back(meshes);
    meshes += model.levels.size();
  }
  assert(meshes <= 65536);
  bins = InstanceBins(meshes);
  mesh_of.reserve(trees);
}

void count_trees(const TreeLayer& trees, std::span<const culling::ObjectRun> objects, std::span<const Rows> blocks,
                 double focal_px, TreeSelection& selection) {
  selection.bins.clear();
  selection.mesh_of.clear();
  for (const culling::ObjectRun& run : objects) {
    const auto [first, last] = trees.table.rows(run);
    for (std::uint32_t i = first; i < last; ++i) {
      const TreeInstance& tree = trees.instances[i];
      const auto kind = static_cast<std::size_t>(tree.kind);
      const std::size_t mesh =
          selection.first_mesh[kind] + level_of(tree, blocks[tree.block], focal_px, selection.models[kind]);
      selection.mesh_of.push_back(static_cast<std::uint16_t>(mesh));
      ++selection.bins.count[mesh];
    }
  }
}

void place_trees(const TreeLayer& trees, std::span<const culling::ObjectRun> objects, std::span<const Rows> blocks,
                 TreeSelection& selection, Instance* slots) {
  selection.bins.start();
  auto mesh = selection.mesh_of.begin();
  for (const culling::ObjectRun& run : objects) {
    const auto [first, last] = trees.table.rows(run);
    for (std::uint32_t i = first; i < last; ++i) {
      const TreeInstance& tree = trees.instances[i];
      slots[selection.bins.next[*mesh++]++] = place(tree, blocks[tree.block]);
    }
  }
}

}  // namespace manzana::draw
