// Lines give way to coarser ones branch after branch: none is shown twice or not at all, and no step changes many.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "foliage/detail.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/leaf_lines.h"
#include "foliage/prepare.h"
#include "foliage/select.h"
#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

constexpr double kDistance = 1000;

/// One plant a kilometre away.
class FarPlant {
 public:
  explicit FarPlant(const Plant& plant) : ready_{prepare(plant, {.visibility_side = 0})} {
    table_ = make_plant_table(ready_);
    table_.details = make_details(ready_, Law::ours);
    sites_ = {make_site(plant_(), 0, plant_().height_m, plant_().crown_radius_m, 0, 1)};
    sites_[0].inv_scale2 = 1;
  }

  /// Rows of the plant's lines, coarse ones after the finest.
  std::vector<std::uint32_t> lines(double error_m) const {
    const std::vector<Vec4> rows{{1, 0, 0, 0}, {0, 1, 0, kDistance}, {0, 0, 1, -table_.plants[0].middle}};
    const std::vector<Run> all{{0, 1}};
    Selection chosen;
    select(table_, {sites_, rows, all, error_m / kDistance}, chosen);
    std::vector<std::uint32_t> lines;
    for (const Item& item : chosen.items)
      for (std::uint32_t rank = 0; item.kind == glsl::kLines && rank < item.count; ++rank)
        lines.push_back(rank + (rank < static_cast<std::uint32_t>(item.edge) ? item.first : item.second));
    return lines;
  }

  const LineSegment& line(std::uint32_t row) const {
    const std::size_t fine = plant_().lines.size();
    return row < fine ? plant_().lines[row] : plant_().coarse_lines[row - fine];
  }
  std::size_t level(std::uint32_t row) const {
    const std::size_t fine = plant_().lines.size();
    std::size_t level = 0;
    for (const LineLevel& l : plant_().line_levels) level += row >= fine + l.lines.first ? 1 : 0;
    return level;
  }
  double widest_m() const { return static_cast<double>(plant_().line_levels.back().error_m) / 8; }

 private:
  const PreparedPlant& plant_() const { return ready_[0]; }

  std::vector<PreparedPlant> ready_;
  PlantTable table_;
  std::vector<TreeSite> sites_;
};

/// The share of `now` that is not in `before`.
double new_share(std::vector<std::uint32_t> before, std::vector<std::uint32_t> now) {
  std::sort(before.begin(), before.end());
  std::sort(now.begin(), now.end());
  std::vector<std::uint32_t> fresh;
  std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(fresh));
  return static_cast<double>(fresh.size()) / static_cast<double>(std::max<std::size_t>(now.size(), 1));
}

Plant branches_and_blades() {
  Plant plant = spiral_plant(200);
  Plant grass = leaves_on_ground(2000, 0.01F, 2);
  plant.mesh.leaves = std::move(grass.mesh.leaves);
  plant.terminals = std::move(grass.terminals);
  return plant;
}

}  // namespace

TEST_CASE("each branch's lines are of one level, and a step of the error changes few") {
  const bool blades = GENERATE(false, true);
  const FarPlant shown(blades ? branches_and_blades() : grow_plant(builtin_species("oak"), 3));
  std::vector<std::uint32_t> before;
  std::size_t mixed = 0;
  double most_new = 0;
  for (double error_m = shown.widest_m() / 32; error_m < 4 * shown.widest_m(); error_m *= 1.01) {
    const std::vector<std::uint32_t> lines = shown.lines(error_m);
    std::map<std::uint32_t, std::size_t> level_of;
    std::size_t lowest = 99, highest = 0;
    for (const std::uint32_t row : lines) {
      const std::size_t level = shown.level(row);
      lowest = std::min(lowest, level), highest = std::max(highest, level);
      const std::uint32_t branch = shown.line(row).branch;
      if (branch != kOfLeaf) REQUIRE(level_of.try_emplace(branch, level).first->second == level);
    }
    if (!lines.empty()) CHECK(highest - lowest <= 1);
    mixed += highest > lowest ? 1 : 0;
    CHECK(std::adjacent_find(lines.begin(), lines.end()) == lines.end());
    if (lines.size() > 50 && before.size() > 50) most_new = std::max(most_new, new_share(before, lines));
    before = lines;
  }
  INFO("at most " << most_new << " of the lines are new; levels mixed in " << mixed << " steps");
  CHECK(mixed > 100);
  CHECK(most_new < 0.15);
}

}  // namespace manzana::foliage
