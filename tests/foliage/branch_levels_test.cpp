#include "foliage/branch_levels.h"

#include <catch2/catch.hpp>
#include <limits>

#include "tiny_plants.h"

namespace manzana::foliage {

TEST_CASE("each step of a level has one branch more as mesh and one less as lines") {
  const Plant plant = spiral_plant(20);
  PreparedPlant ready;
  prepare_branches(plant, {}, ready);
  for (std::size_t l = 0; l < ready.branch_levels.size(); ++l) {
    const BranchLevel& level = ready.branch_levels[l];
    const std::uint32_t next = l + 1 < ready.branch_levels.size() ? ready.branch_levels[l + 1].branches : 0;
    REQUIRE(level.steps.size() == level.branches - next + 1);
    const BranchStep all = branch_step(ready, l, 0);
    CHECK(all.quads == level.quads.size());
    CHECK(all.first_line == level.first_line);
    for (const float nothing : {-1.0F, std::numeric_limits<float>::quiet_NaN()})
      CHECK(branch_step(ready, l, nothing).quads == all.quads);
    CHECK(branch_step(ready, l, 1).first_line == branch_step(ready, l, 2).first_line);
    CHECK(branch_step(ready, l, 1).first_line ==
          (l + 1 < ready.branch_levels.size() ? ready.branch_levels[l + 1].first_line : 0));
  }
}

}  // namespace manzana::foliage
