#include "foliage/prepared_plant.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"

using namespace manzana::foliage;

TEST_CASE("prepared plants keep their rules, and each broken rule is named") {
  const PreparedPlant good = prepare(grow_plant(builtin_species("shrub"), 3));
  check(good);
  const struct {
    std::function<void(PreparedPlant&)> harm;
    const char* says;
  } cases[] = {
      {[](auto& p) { p.height_m = NAN; }, "size"},
      {[](auto& p) { p.crown_radius_m = -1; }, "size"},
      {[](auto& p) { p.leaf_image.size = 100; }, "leaf image has a side that is no power of two"},
      {[](auto& p) { p.leaf_image.size = -4; }, "leaf image is too large"},
      {[](auto& p) { p.bark_image.rgba.pop_back(); }, "bark image has not as many texels"},
      {[](auto& p) { p.bark[2].corners[1].position.x = NAN; }, "bark quad 2"},
      {[](auto& p) { p.lines[1].radius_b = -1; }, "line 1"},
      {[](auto& p) { p.lines[0].b.z = HUGE_VALF; }, "line 0"},
      {[](auto& p) { p.branch_levels[0].quads.last = 1U << 30; }, "branch level 0"},
      {[](auto& p) {
         p.branch_levels[0].quads = {5, 4};
       },
       "branch level 0"},
      {[](auto& p) { p.branch_levels[0].first_line = 1U << 30; }, "branch level 0"},
      {[](auto& p) {
         p.branch_steps.push_back({1U << 30, 0, 0});
       },
       "branch step"},
      {[](auto& p) { p.branch_steps[0].branches = 1U << 30; }, "branch step 0"},
      {[](auto& p) { p.coarse_lines[0].radius_a = NAN; }, "coarse line 0"},
      {[](auto& p) { p.line_levels[2].lines.last = 1U << 30; }, "line level 2"},
      {[](auto& p) { p.line_levels[0].error_m = NAN; }, "line level 0"},
      {[](auto& p) { p.line_firsts.pop_back(); }, "not every branch has its first line"},
      {[](auto& p) { p.line_firsts[1] = 1U << 30; }, "first line 1"},
      {[](auto& p) { p.line_firsts.back() = 0; }, "first line"},
      {[](auto& p) { p.leaves[7].anchor.y = 2e6F; }, "leaf quad 7"},
      {[](auto& p) { p.cells[0].quads.last += 1; }, "cell 1"},
      {[](auto& p) { p.cells.back().quads.last += 1; }, "cell"},
      {[](auto& p) { p.cells.pop_back(); }, "not every leaf quad has a cell"},
      {[](auto& p) { p.cells[0].axes[1].x = NAN; }, "cell 0"},
      {[](auto& p) { p.shuffled[0] = p.shuffled[1]; }, "shuffled quad 1"},
      {[](auto& p) { p.shuffled[3] = 1U << 30; }, "shuffled quad 3"},
      {[](auto& p) { p.shuffled.pop_back(); }, "not every leaf quad"},
      {[](auto& p) { p.points[4].area = NAN; }, "point 4"},
      {[](auto& p) { p.point_levels[0].points.last -= 1; }, "point level 0"},
      {[](auto& p) { p.large_points = 3; }, "point level 0"},
      {[](auto& p) { p.large_quads = 1U << 30; }, "large"},
      {[](auto& p) { p.point_levels[0].area = NAN; }, "point level 0"},
      {[](auto& p) { p.visibility.side = 8; }, "visibility"},
      {[](auto& p) { p.visibility.side = 1U << 31; }, "visibility"},
      {[](auto& p) { p.leaf_area_m2 = -1; }, "leaf area"},
      {[](auto& p) { p.leaf_scale[3] = NAN; }, "leaf scales"},
  };
  for (const auto& c : cases) {
    PreparedPlant bad = good;
    c.harm(bad);
    CHECK_THROWS_WITH(check(bad), Catch::Contains(c.says));
    CHECK_THROWS_AS(check(bad), std::invalid_argument);
  }
}
