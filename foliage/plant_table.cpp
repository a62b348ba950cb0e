#include "foliage/plant_table.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "foliage/wind.h"

namespace manzana::foliage {
namespace {

template <class T>
void fill_levels(const std::vector<T>& levels, const char* what, std::span<glm::uvec4> out,
                 glm::uvec4 (*row)(const T&)) {
  if (levels.size() > out.size()) throw std::invalid_argument(std::string("too many levels of ") + what);
  std::transform(levels.begin(), levels.end(), out.begin(), row);
}

std::uint32_t size_of(const auto& list) { return static_cast<std::uint32_t>(list.size()); }

void set_size(const PreparedPlant& plant, PlantHead& head) {
  head.middle = plant.height_m / 2;
  head.near2 = head.middle * head.middle + plant.crown_radius_m * plant.crown_radius_m;
  head.per_near2 = 1 / (3 * head.near2);
  head.crown = plant.crown_radius_m;
  head.density = density_of(plant);
}

/// The finest lines stand before the coarse ones.
void add_lines(const PreparedPlant& plant, PlantHead& head, std::vector<glm::uvec2>& steps) {
  const std::uint32_t fine = size_of(plant.lines);
  head.line_levels = plant.line_firsts.empty() ? 0 : 1 + size_of(plant.line_levels);
  head.branches = plant.branch_levels.empty() ? 0 : plant.branch_levels.front().branches;
  head.first_line_row = size_of(steps);
  for (std::size_t i = 0; i < plant.line_firsts.size(); ++i)
    steps.emplace_back(plant.line_firsts[i] + (i <= head.branches + 1 ? 0 : fine), 0);
}

void add_branches(const PreparedPlant& plant, PlantHead& head, std::vector<glm::uvec2>& steps) {
  head.bark_levels = size_of(plant.branch_levels);
  fill_levels<BranchLevel>(plant.branch_levels, "branches", head.bark, [](const BranchLevel& l) {
    return glm::uvec4(l.quads.first, l.steps.first, l.steps.size(), 0);
  });
  head.first_step = size_of(steps);
  for (const BranchStep& step : plant.branch_steps) steps.emplace_back(step.quads, step.branches);
  add_lines(plant, head, steps);
}

void set_points(const PreparedPlant& plant, PlantHead& head) {
  head.point_levels = size_of(plant.point_levels);
  fill_levels<PointLevel>(plant.point_levels, "points", head.points,
                          [](const PointLevel& l) { return glm::uvec4(l.points.first, l.points.size(), 0, 0); });
}

/// The greatest distance of a corner, by f(quad, corner), rounded up.
template <class F>
float farthest(const PreparedPlant& plant, const LeafCell& cell, F&& f) {
  float most = 0;
  for (std::uint32_t i = cell.quads.first; i < cell.quads.last; ++i)
    for (const PlantQuad::Corner& corner : plant.leaves[i].corners)
      most = std::max(most, f(plant.leaves[i], corner.position));
  return most * 1.00001F;
}

float radius_of(const PreparedPlant& plant, const LeafCell& cell) {
  return farthest(plant, cell, [&](const PlantQuad&, const Vec3& p) { return glm::distance(p, cell.centre); });
}

float leaf_of(const PreparedPlant& plant, const LeafCell& cell) {
  return farthest(plant, cell, [](const PlantQuad& quad, const Vec3& p) { return glm::distance(p, quad.anchor); });
}

/// A plant's leaves stand behind its bark.
void add_cells(const PreparedPlant& plant, PlantHead& head, std::vector<CellHead>& cells) {
  head.first_cell = size_of(cells);
  head.cells = size_of(plant.cells);
  for (const LeafCell& cell : plant.cells)
    cells.push_back({cell.centre, size_of(plant.bark) + cell.quads.first, cell.quads.size(), radius_of(plant, cell),
                     leaf_of(plant, cell), static_cast<float>(kMostSway) * plant.height_m});
}

void add_visibility(const Visibility& visibility, PlantHead& head, std::vector<std::uint32_t>& views) {
  head.first_view = size_of(views) * 4;
  head.view_side = visibility.side;
  const std::vector<std::uint8_t>& share = visibility.share;
  for (std::size_t i = 0; i < share.size(); i += 4) {
    std::uint32_t word = 0;
    for (std::size_t j = i; j < std::min(i + 4, share.size()); ++j) word |= std::uint32_t{share[j]} << (8 * (j - i));
    views.push_back(word);
  }
}

}  // namespace

float density_of(const PreparedPlant& plant) {
  const float ellipse = std::numbers::pi_v<float> * plant.height_m / 2 * plant.crown_radius_m;
  return ellipse > 0 ? std::min(plant.cover_m2 / ellipse, 1.0F) : 0;
}

PlantTable make_plant_table(std::span<const PreparedPlant> plants) {
  PlantTable table;
  std::uint32_t quads = 0, lines = 0, points = 0;
  for (const PreparedPlant& plant : plants) {
    PlantHead& head = table.plants.emplace_back();
    head.first_quad = quads;
    head.first_line = lines;
    head.first_point = points;
    set_size(plant, head);
    add_branches(plant, head, table.steps);
    set_points(plant, head);
    add_cells(plant, head, table.cells);
    add_visibility(plant.visibility, head, table.views);
    quads += size_of(plant.bark) + size_of(plant.leaves);
    lines += size_of(plant.lines) + size_of(plant.coarse_lines);
    points += size_of(plant.points);
  }
  return table;
}

std::uint32_t leaf_quads(const PlantTable& table, const PlantHead& plant) {
  const auto first = table.cells.begin() + plant.first_cell;
  return std::accumulate(first, first + plant.cells, 0U,
                         [](std::uint32_t sum, const CellHead& cell) { return sum + cell.count; });
}

std::uint32_t lines_from(const PlantTable& table, const PlantHead& plant, std::uint32_t level, std::uint32_t branch) {
  if (plant.line_levels == 0) return 0;
  const std::uint32_t row = plant.first_line_row + std::min(level, plant.line_levels - 1) * (plant.branches + 2);
  return table.steps[row + plant.branches].x - table.steps[row + branch].x;
}

std::uint32_t leaf_lines(const PlantTable& table, const PlantHead& plant, std::uint32_t level) {
  if (plant.line_levels == 0) return 0;
  const std::uint32_t row = plant.first_line_row + std::min(level, plant.line_levels - 1) * (plant.branches + 2);
  return table.steps[row + plant.branches + 1].x - table.steps[row + plant.branches].x;
}

}  // namespace manzana::foliage
