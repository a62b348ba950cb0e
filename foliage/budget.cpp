#include "foliage/budget.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace manzana::foliage {
namespace {

/// Of a plant's cells over all directions; 1 where nothing is baked.
double mean_visibility(const PlantTable& table, const PlantHead& plant) {
  const std::size_t n = std::size_t{plant.cells} * plant.view_side * plant.view_side;
  if (n == 0) return 1;
  double sum = 0;
  for (std::size_t i = plant.first_view; i < plant.first_view + n; ++i)
    sum += (table.views[i / 4] >> (8 * (i % 4))) & 255U;
  return sum / (255 * static_cast<double>(n));
}

double leaf_quads(const PlantTable& table, const PlantHead& plant) {
  const auto first = table.cells.begin() + plant.first_cell;
  return std::accumulate(first, first + plant.cells, 0.0,
                         [](double sum, const CellHead& cell) { return sum + cell.count; });
}

/// The mesh and the lines of a level, as the shader's branch_step() has them.
double branch_quads(const PlantTable& table, const PlantHead& plant, const Detail& d) {
  if (plant.bark_levels == 0) return 0;
  const std::uint32_t level = std::min(static_cast<std::uint32_t>(d.bark), plant.bark_levels - 1);
  const std::uint32_t last = plant.bark[level].z - 1;
  const float gone = std::min(d.bark - static_cast<float>(level), 1.0F) * static_cast<float>(last);
  const glm::uvec2 step =
      table.steps[plant.first_step + plant.bark[level].y + last - std::min(static_cast<std::uint32_t>(gone), last)];
  return step.x + std::max(0.0, static_cast<double>(d.lines) - step.y);
}

std::uint32_t bits_of(double error2) {
  return std::bit_cast<std::uint32_t>(std::clamp(static_cast<float>(error2), 0x1p-32F, 65535.0F));
}

/// As the shader's detail_at() has it.
std::uint32_t row_of(std::uint32_t bits) { return (bits >> 21) - 380; }

/// Linear between two rows of a plant.
double cost_at(const CostTable& costs, std::size_t first_row, double error2) {
  const std::uint32_t bits = bits_of(error2);
  const float* row = &costs.vertices[first_row + row_of(bits)];
  return static_cast<double>(std::lerp(row[0], row[1], static_cast<float>(bits & 0x1fffffU) * 0x1p-21F));
}

void sort_by_error(const PlantTable& table, const TreesSeen& seen, std::vector<CostTable::Bin>& bins) {
  std::fill(bins.begin(), bins.end(), CostTable::Bin{});
  const float at_1m = error2_at_1m(seen.error_at_1m);
  for (const Run& run : seen.runs) {
    for (std::uint32_t i = run.first; i < run.last; ++i) {
      const TreeSite& site = seen.sites[i];
      const Vec4* rows = &seen.block_rows[std::size_t{site.block} * 3];
      const Vec4 middle(site.position + Vec3(0, 0, table.plants[site.plant].middle * site.height), 1);
      const Vec3 p(glm::dot(rows[0], middle), glm::dot(rows[1], middle), glm::dot(rows[2], middle));
      const auto error2 = static_cast<double>(glm::dot(p, p) * site.inv_scale2 * at_1m);
      CostTable::Bin& bin = bins[site.plant * glsl::kDetailSteps + row_of(bits_of(error2))];
      bin.trees += 1;
      bin.error2 += error2;
    }
  }
}

/// Vertices with the error multiplied by `times`.
double total(const CostTable& costs, double times) {
  double sum = 0;
  for (std::size_t i = 0; i < costs.bins.size(); ++i) {
    const CostTable::Bin& bin = costs.bins[i];
    if (bin.trees == 0) continue;
    const std::size_t first_row = i / glsl::kDetailSteps * glsl::kDetailSteps;
    sum += bin.trees * cost_at(costs, first_row, bin.error2 / bin.trees * times * times);
  }
  return sum;
}

}  // namespace

CostTable make_costs(const PlantTable& table) {
  CostTable costs;
  costs.vertices.reserve(table.details.size());
  for (std::size_t i = 0; i < table.plants.size(); ++i) {
    const PlantHead& plant = table.plants[i];
    const double quads = leaf_quads(table, plant), visible = mean_visibility(table, plant);
    for (std::size_t row = 0; row < glsl::kDetailSteps; ++row) {
      const Detail& d = table.details[i * glsl::kDetailSteps + row];
      const auto points = static_cast<double>(d.to_points);
      const double seen = std::lerp(1.0, visible, static_cast<double>(d.hidden));
      const double leaves = quads * seen * static_cast<double>(d.share) * (1 - points);
      costs.vertices.push_back(
          static_cast<float>(4 * (leaves + branch_quads(table, plant, d)) + static_cast<double>(d.points) * points));
    }
  }
  costs.bins.resize(costs.vertices.size());
  return costs;
}

double error_for(CostTable& costs, const PlantTable& table, const TreesSeen& seen, const Budget& budget) {
  if (!(budget.vertices > 0)) return seen.error_at_1m;
  sort_by_error(table, seen, costs.bins);
  double low = 0, high = std::log2(budget.most_error);  // the cost falls in between
  if (total(costs, 1) <= budget.vertices) return seen.error_at_1m;
  for (int i = 0; i < 16; ++i) {
    const double middle = (low + high) / 2;
    (total(costs, std::exp2(middle)) > budget.vertices ? low : high) = middle;
  }
  return seen.error_at_1m * std::exp2(high);
}

}  // namespace manzana::foliage
