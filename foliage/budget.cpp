#include "foliage/budget.h"

#include <algorithm>
#include <bit>
#include <cmath>

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

/// Between two levels.
double leaf_line_quads(const PlantTable& table, const PlantHead& plant, const Detail& d) {
  const auto fine = static_cast<std::uint32_t>(d.line_level);
  const double from = leaf_lines(table, plant, fine), to = leaf_lines(table, plant, fine + 1);
  return static_cast<double>(d.to_lines) * (1 - static_cast<double>(d.to_points)) *
         std::lerp(from, to, static_cast<double>(d.line_level) - fine);
}

/// The mesh and the lines of a level, as the shader's branch_step() has them.
double branch_quads(const PlantTable& table, const PlantHead& plant, const Detail& d) {
  if (plant.bark_levels == 0) return 0;
  const std::uint32_t level = std::min(static_cast<std::uint32_t>(d.bark), plant.bark_levels - 1);
  const std::uint32_t last = plant.bark[level].z - 1;
  const float gone = std::min(d.bark - static_cast<float>(level), 1.0F) * static_cast<float>(last);
  const glm::uvec2 step =
      table.steps[plant.first_step + plant.bark[level].y + last - std::min(static_cast<std::uint32_t>(gone), last)];
  const auto fine = static_cast<std::uint32_t>(d.line_level);
  const double from = lines_from(table, plant, fine, step.y), to = lines_from(table, plant, fine + 1, step.y);
  const double lines = std::lerp(from, to, static_cast<double>(d.line_level) - fine);
  return step.x + static_cast<double>(d.lines) * lines;
}

std::uint32_t bits_of(double error2) {
  return std::bit_cast<std::uint32_t>(std::clamp(static_cast<float>(error2), 0x1p-32F, 65535.0F));
}

/// As the shader's detail_at() has it.
std::uint32_t row_of(std::uint32_t bits) { return (bits >> 21) - 380; }

/// Linear between two rows of a plant.
Vec2d cost_at(const CostTable& costs, std::size_t first_row, double error2) {
  const std::uint32_t bits = bits_of(error2);
  const Vec2* row = &costs.vertices[first_row + row_of(bits)];
  return Vec2d(glm::mix(row[0], row[1], static_cast<float>(bits & 0x1fffffU) * 0x1p-21F));
}

/// A row's least error, squared; of the first row 0, since smaller ones are counted there.
double least_error2(std::size_t row) {
  return row == 0 ? 0 : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(row + 380) << 21));
}

std::size_t row_at(double error2) { return row_of(bits_of(error2)); }

/// The least that the square of the nearest cell's error may be, over that of the tree.
constexpr std::array<double, 5> kNearness{0, 0.2, 0.5, 0.75, 0.9};

std::size_t nearness(float distance, float reach) {
  constexpr float kMoreReach = 1.01F;  // than floats can be wrong
  const float share = 1 - kMoreReach * reach / std::max(distance, 1e-3F);
  const double share2 = share > 0 ? static_cast<double>(share * share) : 0;
  std::size_t i = kNearness.size() - 1;
  while (share2 < kNearness[i]) --i;
  return i;
}

/// Of a ball of cells: what each side leaves of it, as if there were no other.
double share_in_view(const ViewSides& sides, const Vec3& middle, float radius, float cell) {
  double share = 1;
  for (const Vec4& side : sides) {
    const float inside = glm::dot(Vec3(side), middle) + side.w + cell;
    const auto t = static_cast<double>(std::clamp(0.5F + 0.5F * inside / std::max(radius, 1e-3F), 0.0F, 1.0F));
    share *= t * t * (3 - 2 * t);
  }
  return share;
}

void sort_by_error(CostTable& costs, const PlantTable& table, const TreesSeen& seen) {
  std::fill(costs.bins.begin(), costs.bins.end(), CostTable::Bin{});
  for (const Run& run : seen.runs) {
    for (std::uint32_t i = run.first; i < run.last; ++i) {
      const TreeSite& site = seen.sites[i];
      const TreeError error = error_of_tree(table, seen, i);
      const auto error2 = static_cast<double>(error.error2);
      CostTable::Bin& bin = costs.bins[site.plant * glsl::kDetailSteps + row_at(error2)];
      bin.trees += 1;
      bin.error2 += error2;
      const ListBounds::Plant& plant = costs.lists.plants[site.plant];
      const float scale = std::max(site.radius, site.height), reach = scale * plant.reach;
      bin.leaves += share_in_view(seen.sides, error.middle, reach, scale * plant.cell);
      bin.by_nearness[nearness(glm::length(error.middle), reach)] += 1;
    }
  }
}

/// f(bin, plant, row), of all that are not empty.
template <class F>
void for_each_bin(const CostTable& costs, F&& f) {
  for (std::size_t i = 0; i < costs.bins.size(); ++i)
    if (costs.bins[i].trees > 0) f(costs.bins[i], i / glsl::kDetailSteps, i % glsl::kDetailSteps);
}

/// Vertices with the error multiplied by `times`.
double total(const CostTable& costs, double times) {
  double sum = 0;
  for_each_bin(costs, [&](const CostTable::Bin& bin, std::size_t plant, std::size_t) {
    sum += glm::dot(Vec2d(bin.leaves, bin.trees),
                    cost_at(costs, plant * glsl::kDetailSteps, bin.error2 / bin.trees * times * times));
  });
  return sum;
}

/// At most so much of each list, whatever the errors are within a row: those of the trees in it span two rows or three
/// once multiplied.
ListSizes most_lists(const CostTable& costs, double times) {
  constexpr double kLess = 0.999, kMore = 1.001;  // than floats can be wrong
  ListSizes sum(0);
  for_each_bin(costs, [&](const CostTable::Bin& bin, std::size_t plant, std::size_t row) {
    const double least2 = least_error2(row) * times * times * kLess;
    const std::size_t low = row_at(least2), high = row_at(least_error2(row + 1) * times * times * kMore);
    ListSizes most(0);
    for (std::size_t i = low; i <= high; ++i) most = glm::max(most, costs.lists.others[plant * glsl::kDetailSteps + i]);
    sum += bin.trees * most;
    for (std::size_t i = 0; i < kNearness.size(); ++i)
      if (bin.by_nearness[i] > 0)
        sum += bin.by_nearness[i] * most_leaves(costs.lists, plant, row_at(least2 * kNearness[i]), low);
  });
  return sum;
}

bool fits(const ListSizes& sizes, const ListSizes& room) { return glm::all(glm::lessThanEqual(sizes, room)); }

constexpr double kMostOctaves = 24;  // from the least to the greatest error that a table knows

/// Octaves of error until the vertices suffice.
double octaves_for_vertices(const CostTable& costs, const Budget& budget) {
  if (!(budget.vertices > 0) || total(costs, 1) <= budget.vertices) return 0;
  double low = 0, high = std::log2(budget.most_error);  // the cost falls in between
  for (int i = 0; i < 16; ++i) {
    const double middle = (low + high) / 2;
    (total(costs, std::exp2(middle)) > budget.vertices ? low : high) = middle;
  }
  return high;
}

/// And from there on until the lists have room: the least, since one list may grow while others shrink.
double octaves_for_lists(const CostTable& costs, const ListSizes& room, double from) {
  constexpr double kStep = 0.125;
  const auto fit = [&](double octaves) { return fits(most_lists(costs, std::exp2(octaves)), room); };
  double high = from;
  while (!fit(high)) {
    high += kStep;
    if (high > kMostOctaves) return std::numeric_limits<double>::infinity();
  }
  double low = std::max(from, high - kStep);
  for (int i = 0; i < 6 && low < high; ++i) {
    const double middle = (low + high) / 2;
    (fit(middle) ? high : low) = middle;
  }
  return high;
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
      const double leaves =
          quads * seen * static_cast<double>(d.share) * (1 - points) * (1 - static_cast<double>(d.to_lines));
      costs.vertices.emplace_back(4 * leaves, 4 * (branch_quads(table, plant, d) + leaf_line_quads(table, plant, d)) +
                                                  static_cast<double>(d.points) * points);
    }
  }
  costs.lists = make_list_bounds(table);
  costs.bins.resize(costs.vertices.size());
  return costs;
}

double error_for(CostTable& costs, const PlantTable& table, const TreesSeen& seen, const Budget& budget) {
  const bool bounded = glm::any(glm::lessThan(budget.room, ListSizes(std::numeric_limits<double>::infinity())));
  if (!(budget.vertices > 0) && !bounded) return seen.error_at_1m;
  sort_by_error(costs, table, seen);
  return seen.error_at_1m * std::exp2(octaves_for_lists(costs, budget.room, octaves_for_vertices(costs, budget)));
}

}  // namespace manzana::foliage
