#pragma once
/// The way over a forest and into it with the settings of a quality: what its frames take, and how true they are.
///   const ForestPathPlan plan = forest_path_plan(quick);
///   Forest forest(plants, plan.trees, plan.most_full_quads);
///   add_forest_path(forest, plan, times);                                       // rows of times.csv
///   measure_forest_errors(forest.ground, forest.path(plan.stops, plan.height_px), plan.errors, ...);
#include "apps/foliage_benchmark/forest_errors.h"
#include "apps/foliage_benchmark/source_forest.h"

namespace manzana::foliage_benchmark {

struct ForestPathPlan {
  std::uint32_t trees = 4000;
  double most_full_quads = 2e6;
  int height_px = 720;                ///< 16 : 9
  int frames = 128, rounds = 3;       ///< that are timed, each so often: the least counts
  int stops = 20;                     ///< evenly along the path, for counts and errors
  std::uint32_t many_trees = 10'000;  ///< from above, and ten times as many
  ForestErrorPlan errors;
};
/// As `--quality balanced` has it.
ForestPathPlan forest_path_plan(bool quick);

inline constexpr const char* kForestPath = "forest path";
void add_forest_path(Forest& forest, const ForestPathPlan& plan, Times& times);

}  // namespace manzana::foliage_benchmark
