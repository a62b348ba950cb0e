#include "apps/foliage_benchmark/forest_path.h"

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/times_md.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::foliage_benchmark {

ForestPathPlan forest_path_plan(bool quick) {
  ForestPathPlan plan;
  plan.errors.exactness.error_px = draw::quality_named("balanced").tree_error_px;
  if (!quick) return plan;
  plan.trees = 300;
  plan.many_trees = 200;
  plan.height_px = 360;
  plan.frames = 12;
  plan.rounds = 1;
  plan.stops = 3;
  plan.errors.windows = 2;
  plan.errors.fine = 8;
  plan.errors.mode = "quick";
  return plan;
}

void add_forest_path(Forest& forest, const ForestPathPlan& plan, Times& times) {
  const std::string name = std::to_string(forest.plants.size()) + " species";
  const Exactness& exactness = plan.errors.exactness;
  const auto stops = forest.path(plan.stops, plan.height_px), path = forest.path(plan.frames, plan.height_px);
  for (std::size_t i = 0; i < stops.size(); ++i)
    times.add({.table = kForestPath, .plant = name, .way = "frame " + std::to_string(i)},
              [&](TimeRow& row) { forest.ground.look(stops[i], exactness, plan.rounds, row); });
  times.add({.table = kForestPath, .plant = name, .way = std::to_string(plan.frames) + " frames"},
            [&](TimeRow& row) { forest.ground.fly(path, exactness, plan.rounds, row); });
  const TimeRow& all = times.rows.back();
  times.text += "## A forest along a path\n\n" + apps::grouped(plan.trees) + " trees of " + name + ", " +
                std::to_string(plan.height_px) + " rows, with the settings of `--quality balanced` (" +
                apps::digits3(exactness.error_px) +
                " pixels of error, 4 samples, mosaics, groves, neighbours): culling, choice, extraction and drawing of "
                "the trees alone, with the far side made. Frames: median " +
                apps::digits3(all.ms.value_or(0)) + " ms (meant: 150), 99th percentile " +
                apps::digits3(all.ms_99.value_or(0)) + " ms (meant: 300).\n\n" + rows_md(times.rows, kForestPath);
}

}  // namespace manzana::foliage_benchmark
