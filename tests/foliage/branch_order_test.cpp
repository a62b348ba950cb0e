#include "foliage/branch_order.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

std::vector<BranchShape> shapes_of(const Plant& plant) {
  std::vector<BranchShape> shapes;
  for (const Branch& branch : plant.branches) shapes.push_back(branch_shape(plant, branch));
  return shapes;
}

std::vector<std::uint32_t> order_of(const Plant& plant, BranchOrder by) {
  return importance_order(plant, shapes_of(plant), by);
}

/// A trunk with a long thin branch, a short thick one, and a thin one that carries two twigs.
Plant plant_of_kinds() {
  Plant plant;
  add_straight_branch(plant, -1, {0, 0, 0}, {0, 0, 6}, 0.2F);
  add_straight_branch(plant, 0, {0, 0, 2}, {4, 0, 3}, 0.02F);
  add_straight_branch(plant, 0, {0, 0, 3}, {-1.5F, 0, 3.5F}, 0.1F);
  add_straight_branch(plant, 0, {0, 0, 4}, {0, 0.5F, 4.5F}, 0.01F);
  add_straight_branch(plant, 3, {0, 0.2F, 4.2F}, {0.2F, 0.4F, 4.4F}, 0.005F);
  add_straight_branch(plant, 3, {0, 0.4F, 4.4F}, {0.2F, 0.6F, 4.6F}, 0.005F);
  return plant;
}

}  // namespace

TEST_CASE("each measure puts its own branch next to the trunk") {
  const Plant plant = plant_of_kinds();
  CHECK(order_of(plant, BranchOrder::length)[1] == 1);
  CHECK(order_of(plant, BranchOrder::area)[1] == 2);
  CHECK(order_of(plant, BranchOrder::width)[1] == 2);
  CHECK(order_of(plant, BranchOrder::count)[1] == 3);
  Plant dark = plant;
  for (std::uint32_t i = 3 * dark.branches[2].triangles.first; i < 3 * dark.branches[2].triangles.last; ++i)
    dark.mesh.bark.vertices[dark.mesh.bark.indices[i]].shade = 0.05F;
  CHECK(order_of(plant, BranchOrder::visible_area)[1] == 2);
  CHECK(order_of(dark, BranchOrder::visible_area)[1] == 1);
}

TEST_CASE("orders hold every branch and those of trees have parents first") {
  const Plant plant = spiral_plant(40);
  for (const BranchOrder by :
       {BranchOrder::width, BranchOrder::visible_area, BranchOrder::area, BranchOrder::length, BranchOrder::count}) {
    const auto order = order_of(plant, by);
    CHECK(std::set<std::uint32_t>(order.begin(), order.end()).size() == plant.branches.size());
    CHECK(order[0] == 0);
  }
  const auto shapes = shapes_of(plant);
  const auto order = importance_order(plant, shapes, BranchOrder::width);
  CHECK(std::is_sorted(order.begin(), order.end(),
                       [&](auto a, auto b) { return shapes[a].width_m > shapes[b].width_m; }));
}

TEST_CASE("equal branches stay in the order of the plant") {
  Plant plant;
  add_straight_branch(plant, -1, {0, 0, 0}, {0, 0, 6}, 0.2F);
  for (int i = 0; i < 9; ++i) add_straight_branch(plant, 0, {0, 0, 4}, {1, 0, 4}, 0.02F);
  for (const BranchOrder by : {BranchOrder::width, BranchOrder::visible_area, BranchOrder::count}) {
    const auto order = order_of(plant, by);
    CHECK(std::is_sorted(order.begin(), order.end()));
  }
}

}  // namespace manzana::foliage
