#include "foliage/select.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "foliage/random.h"

namespace manzana::foliage {
namespace glsl {
namespace {

using glm::abs;
using uvec2 = glm::uvec2;
using std::max;
using std::min;
inline uint floatBitsToUint(float x) { return std::bit_cast<uint>(x); }

/// The arrays that the shader's functions read, under the shader's names; and the functions themselves.
struct Twin {
  std::span<const TreeSite> sites;
  std::span<const vec4> block_rows;
  std::span<const PlantHead> plants;
  std::span<const CellHead> cells;
  std::span<const Detail> details;
  std::span<const glm::uvec2> steps;
  std::span<const uint> views;
  ViewSides view_sides;
  float error2_at_1m, heed_neighbours;
#define precise
#include "foliage/shaders/hash.glsl"
#include "foliage/shaders/octahedral.glsl"
#include "foliage/shaders/select.glsl"
#undef precise
};

}  // namespace
}  // namespace glsl

namespace {

glsl::Twin twin_of(const PlantTable& table, const TreesSeen& seen) {
  return {seen.sites,
          seen.block_rows,
          table.plants,
          table.cells,
          table.details,
          table.steps,
          table.views,
          seen.sides,
          error2_at_1m(seen.error_at_1m),
          seen.heed_neighbours ? 1.0F : 0.0F};
}

}  // namespace

TreeSite make_site(const PreparedPlant& plant, std::uint32_t index, float height_m, float crown_radius_m, float yaw,
                   std::uint64_t id) {
  constexpr float kJitter = 0.12F;  // of the distance at which detail changes, to either side
  TreeSite site{};
  site.radius = crown_radius_m / plant.crown_radius_m;
  site.height = height_m / plant.height_m;
  site.turn = {std::cos(yaw), std::sin(yaw)};
  site.plant = index;
  const std::uint64_t bits = hash(id);
  site.hash = static_cast<std::uint32_t>(bits);
  const float jitter = 1 + kJitter * (static_cast<float>(bits >> 40) * 0x1p-23F - 1),
              scale = std::max(site.radius, site.height);
  site.inv_scale2 = jitter * jitter / (scale * scale);
  return site;
}

ViewSides sides_of(const culling::FrustumD& frustum, const Vec3d& eye) {
  ViewSides sides;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const culling::PlaneD& plane = frustum.planes[i];
    sides[i] = Vec4(plane.normal, plane.offset + glm::dot(plane.normal, eye - frustum.eye));
  }
  return sides;
}

float error2_at_1m(double error_at_1m) { return static_cast<float>(error_at_1m * error_at_1m); }

TreeError error_of_tree(const PlantTable& table, const TreesSeen& seen, std::uint32_t site) {
  glsl::Twin twin = twin_of(table, seen);
  const TreeRecord tree = twin.place_tree(site);
  return {twin.tree_error2(tree), twin.middle_of(tree)};
}

Detail detail_at(const PlantTable& table, std::uint32_t plant, float error2) {
  return twin_of(table, {}).detail_at(plant, error2);
}

void select(const PlantTable& table, const TreesSeen& seen, Selection& selection) {
  glsl::Twin twin = twin_of(table, seen);
  selection.trees.clear();
  selection.items.clear();
  for (const Run& run : seen.runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) selection.trees.push_back(twin.place_tree(i));
  for (std::uint32_t record = 0; record < selection.trees.size(); ++record) {
    const TreeRecord& tree = selection.trees[record];
    const Detail d = twin.detail_at(tree.plant, twin.tree_error2(tree));
    const auto branches = twin.branch_items(tree, record, d), points = twin.points_items(tree, record, d);
    for (const Item& item : {branches.a, branches.b, points.a, points.b}) selection.items.push_back(item);
  }
  for (std::uint32_t record = 0; record < selection.trees.size(); ++record) {
    const TreeRecord& tree = selection.trees[record];
    const std::uint32_t cells = twin.cells_of(tree, twin.detail_at(tree.plant, twin.tree_error2(tree)));
    for (std::uint32_t cell = 0; cell < cells; ++cell) selection.items.push_back(twin.cell_item(tree, record, cell));
  }
}

Shown count_shown(const Selection& selection) {
  Shown shown;
  const std::array<std::uint64_t*, 4> counts{&shown.bark, &shown.leaves, &shown.lines, &shown.points};
  for (const Item& item : selection.items) *counts[item.kind] += item.count;
  return shown;
}

}  // namespace manzana::foliage
