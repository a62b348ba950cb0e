// Thin leaves as lines: what they hide stays, and they come after the branches'.
#include "foliage/leaf_lines.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "foliage/detail.h"
#include "foliage/prepare.h"
#include "foliage/select.h"
#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

double ribbons_m2(std::span<const LineSegment> lines) {
  return std::accumulate(lines.begin(), lines.end(), 0.0, [](double sum, const LineSegment& l) {
    return sum + static_cast<double>((l.radius_a + l.radius_b) * glm::distance(l.a, l.b));
  });
}

/// A trunk with branches, and thin leaves on the ground.
Plant spiral_in_grass() {
  Plant plant = spiral_plant(50);
  Plant grass = leaves_on_ground(300, 0.01F, 2);
  plant.mesh.leaves = std::move(grass.mesh.leaves);
  plant.terminals = std::move(grass.terminals);
  return plant;
}

std::span<const LineSegment> of_leaves(const PreparedPlant& plant, std::size_t level) {
  const std::size_t rows = plant.line_firsts.size() / (1 + plant.line_levels.size());
  const std::uint32_t first = plant.line_firsts[(level + 1) * rows - 2],
                      last = plant.line_firsts[(level + 1) * rows - 1];
  return std::span(level == 0 ? plant.lines : plant.coarse_lines).subspan(first, last - first);
}

}  // namespace

TEST_CASE("a plant of blades has lines and a plant of cards has none") {
  for (const float wide : {.01F, .2F}) {
    const PreparedPlant ready = prepare(leaves_on_ground(50, wide, 1));
    check(ready);
    REQUIRE(ready.lines.size() == (wide < .1F ? 50 : 0));
    const LeafLineSize size = leaf_line_size(ready);
    CHECK(size.length_m == Approx(wide < .1F ? 0.4 : 0).epsilon(1e-3));
    CHECK(size.width_m == Approx(wide < .1F ? 0.01 : 0).epsilon(1e-3));
    for (const LineSegment& line : ready.lines) CHECK(line.branch == kOfLeaf);
  }
}

TEST_CASE("leaves' lines stand behind the branches' in every level and hide as much") {
  const PreparedPlant ready = prepare(spiral_in_grass());
  check(ready);
  const double all = ribbons_m2(of_leaves(ready, 0));
  REQUIRE(of_leaves(ready, 0).size() == 300);
  std::size_t before = 300;
  for (std::size_t level = 0; level <= ready.line_levels.size(); ++level) {
    const auto lines = of_leaves(ready, level);
    INFO("level " << level << ", " << lines.size() << " lines");
    REQUIRE(!lines.empty());
    CHECK(lines.size() <= before);
    CHECK(ribbons_m2(lines) == Approx(all).epsilon(1e-3));
    for (const LineSegment& line : lines) REQUIRE(line.branch == kOfLeaf);
    if (level > 0) {
      const auto run = ready.line_levels[level - 1].lines;
      for (std::uint32_t i = run.first; i + lines.size() < run.last; ++i)
        REQUIRE(ready.coarse_lines[i].branch != kOfLeaf);
      CHECK(run.last == static_cast<std::uint32_t>(lines.data() + lines.size() - ready.coarse_lines.data()));
    }
    before = lines.size();
  }
  CHECK(before < 10);
}

TEST_CASE("thin leaves are quads, then lines, then points") {
  const std::vector<PreparedPlant> plants{prepare(leaves_on_ground(3000, 0.01F, 1))};
  const auto rows = make_details(plants, Law::ours);
  bool lines_alone = false;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Detail& d = rows[row];
    REQUIRE((d.to_lines >= 0 && d.to_lines <= 1));
    if (row > 0) CHECK(d.to_lines >= rows[row - 1].to_lines);
    lines_alone |= d.to_lines == 1 && d.to_points == 0;
  }
  CHECK(rows.front().to_lines == 0);
  CHECK(lines_alone);
  CHECK(rows.back().to_points == 1);
}

}  // namespace manzana::foliage
