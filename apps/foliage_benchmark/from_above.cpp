#include "apps/foliage_benchmark/from_above.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/times_md.h"

namespace manzana::foliage_benchmark {
namespace {

constexpr const char* kTable = "forest from above";

/// Its middle, so that all of it is as high as the picture; from frame to frame the camera turns.
std::vector<Shot> shots_above(const Forest& forest, int frames, int height_px) {
  constexpr double kHalfFov = std::numbers::pi / 6;  // of screen_shot()
  std::vector<Shot> shots;
  for (int i = 0; i < frames; ++i) {
    const double turn = 0.5 * std::numbers::pi * i / frames, lean = 1e-3;
    shots.push_back(screen_shot({0, 0, forest.half_m / std::tan(kHalfFov)},
                                {lean * std::cos(turn), lean * std::sin(turn), -1}, height_px));
  }
  return shots;
}

void measure(Forest& forest, const ForestPathPlan& plan, TimeRow& row) {
  const auto shots = shots_above(forest, plan.stops, plan.height_px);
  forest.ground.make_far(forest.plants);
  forest.ground.look(shots.front(), plan.errors.exactness, 1, row);
  row.overdraw = forest.ground.overdraw(shots.front(), plan.errors.exactness);
  forest.ground.fly(shots, plan.errors.exactness, plan.rounds, row);
}

}  // namespace

void add_from_above(const std::vector<foliage::PreparedPlant>& plants, const ForestPathPlan& plan, Times& times) {
  const std::size_t first = times.rows.size();
  for (const std::uint32_t trees : {plan.many_trees, 10 * plan.many_trees})
    times.add({.table = kTable,
               .plant = std::to_string(plants.size()) + " species",
               .way = apps::grouped(trees) + " trees that fill the picture's height"},
              [&, trees](TimeRow& row) {
                Forest forest(plants, trees, plan.most_full_quads);
                measure(forest, plan, row);
              });
  const TimeRow &some = times.rows[first], &many = times.rows[first + 1];
  const auto per_pixel = [](const TimeRow& row) {
    return static_cast<double>(row.primitives.value_or(0)) / std::max(1.0, row.covered_px.value_or(0));
  };
  times.text += "## A forest from above\n\nWith the same settings, straight down. Ten times the trees take " +
                apps::digits3(many.ms.value_or(0) / std::max(1e-9, some.ms.value_or(0))) +
                " times the median frame (meant: 1.5), " + apps::digits3(per_pixel(many)) +
                " primitives for each covered pixel (1.5), and draw " + apps::digits3(many.overdraw.value_or(0)) +
                " samples for each that is covered, hidden ones too (3).\n\n" + rows_md(times.rows, kTable);
}

}  // namespace manzana::foliage_benchmark
