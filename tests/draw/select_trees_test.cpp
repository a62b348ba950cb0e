#include "scenegraph/draw/select_trees.h"

#include <catch2/catch.hpp>
#include <map>

#include "tests/draw/hand_scene.h"

namespace manzana::draw {
namespace {

std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

}  // namespace

TEST_CASE("every visible tree is placed once, in the bin of its kind and level") {
  HandBlock block;
  for (std::uint32_t i = 0; i < 500; ++i) {
    TreeInstance tree;
    tree.position = {static_cast<float>(hash(i) % 4000), static_cast<float>(hash(i + 7000) % 4000), 0};
    tree.height_m = 5 + static_cast<float>(i % 11);
    tree.kind = static_cast<PlantKind>(i % 3);
    block.trees.push_back(tree);
  }
  const Scene scene = make_scene({block});
  const auto plants = simple_plants();
  const Vec3d eye(100, 200, 10);
  const std::vector<Rows> rows{relative_to(eye, scene.blocks[0])};
  const std::vector<culling::ObjectRun> runs{{3, 50}, {50, 51}, {200, 500}};
  TreeSelection selection(500, plants);
  constexpr double kFocal = 900;
  count_trees(scene.trees, runs, rows, kFocal, selection);
  std::vector<Instance> slots(selection.bins.total());
  place_trees(scene.trees, runs, rows, selection, slots.data());
  REQUIRE(slots.size() == culling::count(runs));

  std::size_t at = 0;
  std::map<std::size_t, std::size_t> expected;
  for (const culling::ObjectRun& run : runs) {
    for (std::uint32_t i = run.first; i < run.last; ++i) {
      const TreeInstance& tree = scene.trees.instances[i];
      const double half = static_cast<double>(tree.height_m) / 2;
      const Vec3d middle = scene.blocks[0].to_local(Vec3d(tree.position) + Vec3d(0, 0, half));
      const double radius = std::hypot(half, static_cast<double>(tree.crown_radius_m));
      const double px = culling::projected_radius(radius, glm::distance(middle, eye), kFocal);
      ++expected[2 * static_cast<std::size_t>(tree.kind) + (px < 20 ? 1 : 0)];
    }
  }
  for (std::size_t mesh = 0; mesh < selection.bins.count.size(); ++mesh) {
    CHECK(selection.bins.count[mesh] == expected[mesh]);
    for (std::uint32_t k = 0; k < selection.bins.count[mesh]; ++k, ++at) {
      CHECK(static_cast<std::size_t>(slots[at].extra.w) == mesh / 2 * 2);
    }
  }
}

TEST_CASE("a tree is scaled, turned and stood on its foot") {
  HandBlock block;
  TreeInstance tree;
  tree.position = {10, 20, 0};
  tree.height_m = 8;
  tree.crown_radius_m = 2;
  tree.yaw = 1.5707963F;
  block.trees = {tree};
  const Scene scene = make_scene({block});
  const auto plants = simple_plants();
  const std::vector<Rows> rows{relative_to(scene.blocks[0].origin, scene.blocks[0])};
  const std::vector<culling::ObjectRun> runs{{0, 1}};
  TreeSelection selection(1, plants);
  count_trees(scene.trees, runs, rows, 900, selection);
  Instance slot;
  place_trees(scene.trees, runs, rows, selection, &slot);
  CHECK(glm::distance(placed(slot.rows, {1, 0, 0}), Vec3(10, 22, 0)) < 1e-5F);
  CHECK(glm::distance(placed(slot.rows, {0, 0, 1}), Vec3(10, 20, 8)) < 1e-5F);
}

}  // namespace manzana::draw
