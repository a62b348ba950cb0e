#include "foliage/select.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

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
  float error2_at_1m;
#define precise
#include "foliage/shaders/hash.glsl"
#include "foliage/shaders/octahedral.glsl"
#include "foliage/shaders/select.glsl"
#undef precise
};

}  // namespace
}  // namespace glsl

namespace {

template <class T>
void fill_levels(const std::vector<T>& levels, const char* what, std::span<glm::uvec4> out,
                 glm::uvec4 (*row)(const T&)) {
  if (levels.size() > out.size()) throw std::invalid_argument(std::string("too many levels of ") + what);
  std::transform(levels.begin(), levels.end(), out.begin(), row);
}

/// The finest lines stand before the coarse ones.
void add_line_rows(const PreparedPlant& plant, PlantHead& head, std::vector<glm::uvec2>& steps) {
  const auto fine = static_cast<std::uint32_t>(plant.lines.size());
  head.line_levels = static_cast<std::uint32_t>(1 + plant.line_levels.size());
  head.branches = plant.branch_levels.empty() ? 0 : plant.branch_levels.front().branches;
  head.first_line_row = static_cast<std::uint32_t>(steps.size());
  for (std::size_t i = 0; i < plant.line_firsts.size(); ++i)
    steps.emplace_back(plant.line_firsts[i] + (i <= head.branches ? 0 : fine), 0);
}

glsl::Twin twin_of(const PlantTable& table, const TreesSeen& seen) {
  return {seen.sites,    seen.block_rows, table.plants, table.cells,
          table.details, table.steps,     table.views,  error2_at_1m(seen.error_at_1m)};
}

}  // namespace

PlantTable make_plant_table(std::span<const PreparedPlant> plants) {
  PlantTable table;
  std::uint32_t quads = 0, lines = 0, points = 0;
  for (const PreparedPlant& plant : plants) {
    PlantHead& head = table.plants.emplace_back();
    head.first_quad = quads;
    head.first_line = lines;
    head.first_point = points;
    head.first_cell = static_cast<std::uint32_t>(table.cells.size());
    head.cells = static_cast<std::uint32_t>(plant.cells.size());
    head.bark_levels = static_cast<std::uint32_t>(plant.branch_levels.size());
    head.point_levels = static_cast<std::uint32_t>(plant.point_levels.size());
    head.first_view = static_cast<std::uint32_t>(table.views.size()) * 4;
    head.view_side = plant.visibility.side;
    head.first_step = static_cast<std::uint32_t>(table.steps.size());
    head.middle = plant.height_m / 2;
    head.near2 = head.middle * head.middle + plant.crown_radius_m * plant.crown_radius_m;
    head.per_near2 = 1 / (3 * head.near2);
    head.crown = plant.crown_radius_m;
    fill_levels<BranchLevel>(plant.branch_levels, "branches", head.bark, [](const BranchLevel& l) {
      return glm::uvec4(l.quads.first, l.steps.first, l.steps.size(), 0);
    });
    fill_levels<PointLevel>(plant.point_levels, "points", head.points,
                            [](const PointLevel& l) { return glm::uvec4(l.points.first, l.points.size(), 0, 0); });
    for (const BranchStep& step : plant.branch_steps) table.steps.emplace_back(step.quads, step.branches);
    add_line_rows(plant, head, table.steps);
    const auto bark = static_cast<std::uint32_t>(plant.bark.size());
    for (const LeafCell& cell : plant.cells)
      table.cells.push_back({cell.centre, bark + cell.quads.first, cell.quads.size(), 0, 0, 0});
    for (std::size_t i = 0; i < plant.visibility.share.size(); i += 4) {
      std::uint32_t word = 0;
      for (std::size_t j = i; j < std::min(i + 4, plant.visibility.share.size()); ++j)
        word |= std::uint32_t{plant.visibility.share[j]} << (8 * (j - i));
      table.views.push_back(word);
    }
    quads += bark + static_cast<std::uint32_t>(plant.leaves.size());
    lines += static_cast<std::uint32_t>(plant.lines.size() + plant.coarse_lines.size());
    points += static_cast<std::uint32_t>(plant.points.size());
  }
  return table;
}

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

float error2_at_1m(double error_at_1m) { return static_cast<float>(error_at_1m * error_at_1m); }

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
    const Detail d = twin.detail_at(tree.plant, tree.error2);
    const auto branches = twin.branch_items(tree, record, d), points = twin.points_items(tree, record, d);
    for (const Item& item : {branches.a, branches.b, points.a, points.b}) selection.items.push_back(item);
  }
  for (std::uint32_t record = 0; record < selection.trees.size(); ++record) {
    const TreeRecord& tree = selection.trees[record];
    const std::uint32_t cells = twin.cells_of(tree, twin.detail_at(tree.plant, tree.error2));
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
