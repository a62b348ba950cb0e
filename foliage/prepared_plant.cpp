#include "foliage/prepared_plant.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace manzana::foliage {
namespace {

constexpr float kFarthest = 1e6F;
constexpr std::uint32_t kMostDirections = 1024;  // along a side of the grid: more would overflow counts of them

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument("prepared plant: " + what); }

[[noreturn]] void fail(const char* list, std::size_t row, const char* what) {
  fail(std::string(list) + " " + std::to_string(row) + " " + what);
}

bool sane(float v) { return std::abs(v) <= kFarthest; }  // false for NaN
bool sane(const Vec3& v) { return sane(v.x) && sane(v.y) && sane(v.z); }
bool sane(const Mat3& m) { return sane(m[0]) && sane(m[1]) && sane(m[2]); }

bool sane(const PlantQuad& quad) {
  bool all = sane(quad.anchor);
  for (const PlantQuad::Corner& corner : quad.corners) all = all && sane(corner.position);
  return all;
}

bool sane(const LeafPoint& p) { return sane(p.position) && p.area >= 0 && sane(p.area) && sane(p.shade); }

bool sane(const LineSegment& l) {
  return sane(l.a) && sane(l.b) && sane(l.radius_a) && sane(l.radius_b) && l.radius_a >= 0 && l.radius_b >= 0 &&
         sane(l.shade);
}

template <class T>
void check_numbers(const char* list, const std::vector<T>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!sane(rows[i])) fail(list, i, "is not finite or out of range");
}

void check_run(const char* list, std::size_t row, const Run& run, std::size_t end) {
  if (run.last < run.first || run.last > end) fail(list, row, "has a run that leaves its list");
}

void check_image(const char* name, const Image& image) {
  constexpr int kLargest = 8192;
  if (image.size < 0 || image.size > kLargest) fail(std::string(name) + " is too large");
  const auto size = static_cast<std::size_t>(image.size);
  if (size != 0 && !std::has_single_bit(size)) fail(std::string(name) + " has a side that is no power of two");
  if (image.rgba.size() != 4 * size * size) fail(std::string(name) + " has not as many texels as its side says");
}

void check_branches(const PreparedPlant& plant) {
  check_numbers("bark quad", plant.bark);
  check_numbers("line", plant.lines);
  for (std::size_t i = 0; i < plant.branch_levels.size(); ++i) {
    const BranchLevel& level = plant.branch_levels[i];
    check_run("branch level", i, level.quads, plant.bark.size());
    if (level.first_line > plant.lines.size()) fail("branch level", i, "begins beyond the lines");
    if (!sane(level.error_m) || !sane(level.mesh_error_m)) fail("branch level", i, "is not finite or out of range");
    check_run("branch level", i, level.steps, plant.branch_steps.size());
  }
  for (std::size_t i = 0; i < plant.branch_steps.size(); ++i) {
    const BranchStep& step = plant.branch_steps[i];
    if (step.quads > plant.bark.size() || step.first_line > plant.lines.size() ||
        step.branches > plant.branch_levels.front().branches)
      fail("branch step", i, "leaves its lists");
  }
}

void check_line_levels(const PreparedPlant& plant) {
  check_numbers("coarse line", plant.coarse_lines);
  for (std::size_t i = 0; i < plant.line_levels.size(); ++i) {
    check_run("line level", i, plant.line_levels[i].lines, plant.coarse_lines.size());
    if (!sane(plant.line_levels[i].error_m)) fail("line level", i, "is not finite or out of range");
  }
  if (plant.branch_levels.empty() && plant.line_firsts.empty()) return;
  const std::size_t branches = plant.branch_levels.empty() ? 0 : plant.branch_levels.front().branches;
  const std::size_t rows = branches + 2;
  if (plant.line_firsts.size() != rows * (1 + plant.line_levels.size())) fail("not every branch has its first line");
  for (std::size_t i = 0; i < plant.line_firsts.size(); ++i) {
    const bool begins = i % rows == 0;
    if (plant.line_firsts[i] > (i < rows ? plant.lines : plant.coarse_lines).size() ||
        (!begins && plant.line_firsts[i] < plant.line_firsts[i - 1]))
      fail("first line", i, "leaves its list");
  }
}

void check_shuffled(const PreparedPlant& plant) {
  std::vector<bool> seen(plant.leaves.size());
  if (plant.shuffled.size() != seen.size()) fail("not every leaf quad is shuffled");
  for (std::size_t i = 0; i < plant.shuffled.size(); ++i) {
    const std::uint32_t quad = plant.shuffled[i];
    if (quad >= seen.size() || seen[quad]) fail("shuffled quad", i, "does not exist or comes twice");
    seen[quad] = true;
  }
}

void check_cells(const PreparedPlant& plant) {
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < plant.cells.size(); ++i) {
    const LeafCell& cell = plant.cells[i];
    check_run("cell", i, cell.quads, plant.leaves.size());
    if (cell.quads.first != end) fail("cell", i, "does not begin where the one before ends");
    end = cell.quads.last;
    if (!sane(cell.centre) || !sane(cell.axes) || !sane(cell.half)) fail("cell", i, "is not finite or out of range");
  }
  if (end != plant.leaves.size()) fail("not every leaf quad has a cell");
  const Visibility& seen = plant.visibility;
  if (seen.side > kMostDirections) fail("visibility has too many directions");
  if (seen.share.size() != plant.cells.size() * seen.side * seen.side)
    fail("visibility has not as many shares as cells and directions");
}

void check_points(const PreparedPlant& plant) {
  check_numbers("point", plant.points);
  for (std::size_t i = 0; i < plant.point_levels.size(); ++i) {
    check_run("point level", i, plant.point_levels[i].points, plant.points.size());
    if (!(plant.point_levels[i].area >= 0) || std::isinf(plant.point_levels[i].area))
      fail("point level", i, "is not finite or out of range");
  }
  if (plant.large_quads > plant.leaves.size()) fail("more quads are large than there are");
  const std::size_t small = plant.leaves.size() - plant.large_quads;
  if (!plant.point_levels.empty() && plant.point_levels[0].points.size() != 4 * small + plant.large_points)
    fail("point level 0 has not four points a quad");
}

void check_grove(const PreparedPlant& plant) {
  const GroveFit& fit = plant.grove;
  check_run("grove fit", 0, fit.points, plant.points.size());
  const auto wrong = [](float v) { return !(v >= 0 && sane(v)); };
  bool all = std::ranges::none_of(fit.cover_m2, wrong);
  for (std::size_t view = 0; view < kGroveViews; ++view)
    all = all && std::ranges::none_of(fit.area[view], wrong) && std::ranges::none_of(fit.light[view], wrong);
  if (!all) fail("its grove's fit is not finite or out of range");
}

}  // namespace

void check(const PreparedPlant& plant) {
  const auto size = [](float v) { return v >= 0 && sane(v); };
  if (!size(plant.height_m) || !size(plant.crown_radius_m)) fail("its size is not finite or out of range");
  check_image("the leaf image", plant.leaf_image);
  check_image("the bark image", plant.bark_image);
  check_branches(plant);
  check_line_levels(plant);
  check_numbers("leaf quad", plant.leaves);
  check_shuffled(plant);
  check_cells(plant);
  check_points(plant);
  check_grove(plant);
  if (!(plant.leaf_area_m2 >= 0) || std::isinf(plant.leaf_area_m2)) fail("its leaf area is not finite");
  for (const float scale : plant.leaf_scale)
    if (!size(scale)) fail("its leaf scales are not finite or out of range");
  for (const float factor : plant.turning)
    if (!size(factor)) fail("its points' areas among leaf quads are not finite or out of range");
}

}  // namespace manzana::foliage
