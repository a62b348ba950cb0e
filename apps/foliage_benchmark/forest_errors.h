#pragma once
/// How true a forest is along its path. All detail of thousands of trees, finely sampled, is beyond any machine; so of
/// some frames a few windows are drawn, each with the trees that stand in it, just as the whole frame shows them.
///   const auto rows = measure_forest_errors(forest.ground, forest.path(20, 720), plan, progress, record, show);
///   const auto verdicts = judge(rows);
/// The windows of a frame, side by side, are judged as one picture, with floors of its own.
#include "apps/foliage_benchmark/errors.h"
#include "apps/foliage_benchmark/ground.h"

namespace manzana::foliage_benchmark {

struct ForestErrorPlan {
  int windows = 2;            ///< of each frame
  int columns = 6, rows = 6;  ///< of equal windows, that a frame has
  int fine = 32;              ///< samples along a side of a pixel, even
  Exactness exactness;        ///< of ours
  std::uint64_t seed = 1;     ///< of the choice of windows
  std::string mode = "full";  ///< of the run
};

/// Windows of which trees cover a tenth or more, chosen by chance; `number`: the frame's.
std::vector<Shot> windows_of(Ground& ground, const Shot& frame, std::uint64_t number, const ForestErrorPlan& plan);

/// A row each of all detail moved by half a pixel, and with the product's samples, and of ours, finely sampled and with
/// the product's: ErrorRow::plant is "frame_7". `show` is called with the windows of what is new, one way above the
/// other.
std::vector<ErrorRow> measure_forest_errors(Ground& ground, std::span<const Shot> path, const ForestErrorPlan& plan,
                                            const std::function<void(double)>& progress, apps::Record<ErrorRow>& record,
                                            const std::function<void(const std::string&, const Picture&)>& show);

std::string forest_errors_md(std::span<const Verdict> verdicts, const ForestErrorPlan& plan);

}  // namespace manzana::foliage_benchmark
