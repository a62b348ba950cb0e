// Levels of lines: the hidden area of all of them stays, whichever branches still have meshes.
#include "foliage/line_levels.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include "foliage/branch_levels.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "ortho_mask.h"
#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

double ribbons_m2(std::span<const LineSegment> lines) {
  return std::accumulate(lines.begin(), lines.end(), 0.0, [](double sum, const LineSegment& l) {
    return sum + static_cast<double>((l.radius_a + l.radius_b) * glm::distance(l.a, l.b));
  });
}

PreparedPlant prepared(const Plant& plant) {
  PreparedPlant ready;
  prepare_branches(plant, {}, ready);
  return ready;
}

std::span<const LineSegment> lines_of(const PreparedPlant& plant, const LineLevel& level) {
  return std::span(plant.coarse_lines).subspan(level.lines.first, level.lines.size());
}

}  // namespace

TEST_CASE("every level of lines has the area of all lines while it has lines") {
  for (const char* species : {"broadleaf", "conifer", "oak", "birch"}) {
    const Plant plant = grow_plant(builtin_species(species), 3);
    const PreparedPlant ready = prepared(plant);
    REQUIRE(ready.line_levels.size() == 10);
    for (const LineLevel& level : ready.line_levels) {
      INFO(species << " error " << level.error_m << " lines " << level.lines.size());
      if (level.lines.size() > 0)
        CHECK(ribbons_m2(lines_of(ready, level)) == Approx(ribbons_m2(ready.lines)).epsilon(1e-3));
    }
    CHECK(ready.line_levels.front().lines.size() <= ready.lines.size());
    CHECK(ready.line_levels[6].lines.size() < ready.lines.size() / 5);  // as wide as the trunk
  }
}

TEST_CASE("lines of a level are at least a third of its error wide where they stand for many") {
  const PreparedPlant ready = prepared(spiral_plant(200));
  const LineLevel& level = ready.line_levels[5];  // half the trunk's width: all branches are thinner
  for (const LineSegment& line : lines_of(ready, level)) {
    if (line.level == 0) continue;
    CHECK(line.radius_a + line.radius_b > 0.2F * level.error_m);
  }
  const auto branches = [&](const LineLevel& of) {
    std::set<std::uint32_t> rows;
    for (const LineSegment& line : lines_of(ready, of)) rows.insert(line.branch);
    return rows.size();
  };
  CHECK(branches(level) < 201);
  CHECK(branches(ready.line_levels[7]) < branches(level) / 2);
}

TEST_CASE("first lines of each level go with the branches that have meshes") {
  const Plant plant = grow_plant(builtin_species("shrub"), 2);
  const PreparedPlant ready = prepared(plant);
  const std::size_t rows = plant.branches.size() + 2;
  REQUIRE(ready.line_firsts.size() == rows * 11);
  for (std::size_t b = 0; b < rows; ++b) CHECK(ready.line_firsts[b] <= ready.lines.size());
  for (std::size_t l = 0; l < ready.line_levels.size(); ++l) {
    const std::uint32_t* firsts = &ready.line_firsts[(l + 1) * rows];
    CHECK(firsts[0] == ready.line_levels[l].lines.first);
    CHECK(firsts[rows - 2] == ready.line_levels[l].lines.last);  // no leaves'
    CHECK(firsts[rows - 1] == firsts[rows - 2]);
    for (std::size_t b = 0; b + 1 < rows; ++b) REQUIRE(firsts[b] <= firsts[b + 1]);
  }
  for (const BranchStep& step : ready.branch_steps) CHECK(ready.line_firsts[step.branches] == step.first_line);
}

TEST_CASE("a coarse level looks like all lines from afar") {
  const PreparedPlant ready = prepared(grow_plant(builtin_species("broadleaf"), 3));
  const float height = 12;
  const LineLevel& level = ready.line_levels[2];
  double fine = 0, coarse = 0;
  for (int view = 0; view < 6; ++view) {
    const float angle = static_cast<float>(view);
    OrthoMask a({std::cos(angle), std::sin(angle), 0}, {0, 0, 0.5F * height}, 2 * height, 1000), b = a;
    for (const LineSegment& line : ready.lines) a.line(line);
    for (const LineSegment& line : lines_of(ready, level)) b.line(line);
    fine += a.area_m2();
    coarse += b.area_m2();
  }
  CHECK(coarse == Approx(fine).epsilon(0.05));
}

TEST_CASE("a plant without branches has no levels of lines") {
  const PreparedPlant ready = prepared(Plant{});
  CHECK(ready.line_levels.empty());
  CHECK(ready.coarse_lines.empty());
}

}  // namespace manzana::foliage
