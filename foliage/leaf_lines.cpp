#include "foliage/leaf_lines.h"

#include <algorithm>
#include <cmath>

#include "foliage/line_levels.h"

namespace manzana::foliage {
namespace {

std::uint32_t size_of(const auto& rows) { return static_cast<std::uint32_t>(rows.size()); }

double length_of(const LineSegment& line) { return static_cast<double>(glm::distance(line.a, line.b)); }

double area_of(const LineSegment& line) { return static_cast<double>(line.radius_a + line.radius_b) * length_of(line); }

LeafLineSize size_of_lines(std::span<const LineSegment> lines) {
  double area = 0, length = 0, squares = 0;
  for (const LineSegment& line : lines) {
    const double l = length_of(line);
    area += area_of(line), length += l, squares += l * l;
  }
  return length > 0 ? LeafLineSize{area / length, squares / length} : LeafLineSize{};
}

/// The first few, as wide as all of them together.
std::vector<LineSegment> fewer(std::span<const LineSegment> leaves, double width_m, double least_m) {
  const double share = std::min(1.0, width_m / least_m);
  const auto n = static_cast<std::size_t>(std::ceil(share * static_cast<double>(leaves.size())));
  std::vector<LineSegment> out(leaves.begin(), leaves.begin() + static_cast<std::ptrdiff_t>(n));
  double all = 0, left = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) (i < n ? left : all) += area_of(leaves[i]);
  const auto wider = static_cast<float>(left > 0 ? (all + left) / left : 1);
  for (LineSegment& line : out) line.radius_a *= wider, line.radius_b *= wider;
  return out;
}

/// Of a plant without branches.
void add_empty_levels(double width_m, PreparedPlant& ready) {
  constexpr double kWidest = 16;  // times the leaves' width: the finest level's error is a quarter of it
  ready.line_firsts.assign(2, 0);
  for (const float error_m : line_level_errors(static_cast<float>(kWidest * width_m))) {
    ready.line_levels.push_back({{0, 0}, error_m});
    ready.line_firsts.insert(ready.line_firsts.end(), {0, 0});
  }
}

void append(std::vector<LineSegment>& to, std::span<const LineSegment> lines) {
  to.insert(to.end(), lines.begin(), lines.end());
}

}  // namespace

void add_leaf_lines(std::span<const LineSegment> leaves, PreparedPlant& ready) {
  const double width_m = size_of_lines(leaves).width_m;
  if (!(width_m > 0)) return;
  if (ready.line_levels.empty()) add_empty_levels(width_m, ready);
  const std::size_t rows = ready.line_firsts.size() / (1 + ready.line_levels.size());
  append(ready.lines, leaves);
  ready.line_firsts[rows - 1] = size_of(ready.lines);
  std::vector<LineSegment> woven;
  for (std::size_t l = 0; l < ready.line_levels.size(); ++l) {
    LineLevel& level = ready.line_levels[l];
    const auto firsts = std::span(ready.line_firsts).subspan((l + 1) * rows, rows);
    const std::uint32_t first = size_of(woven);
    for (std::uint32_t& row : firsts) row = row - level.lines.first + first;
    append(woven, std::span(ready.coarse_lines).subspan(level.lines.first, level.lines.size()));
    append(woven, fewer(leaves, width_m, static_cast<double>(kThinLine * level.error_m)));
    level.lines = {first, size_of(woven)};
    firsts.back() = level.lines.last;
  }
  ready.coarse_lines = std::move(woven);
}

LeafLineSize leaf_line_size(const PreparedPlant& plant) {
  if (plant.line_firsts.empty()) return {};
  const std::size_t rows = plant.line_firsts.size() / (1 + plant.line_levels.size());
  const std::uint32_t first = plant.line_firsts[rows - 2], last = plant.line_firsts[rows - 1];
  return size_of_lines(std::span(plant.lines).subspan(first, last - first));
}

}  // namespace manzana::foliage
