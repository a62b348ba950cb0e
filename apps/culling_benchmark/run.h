#pragma once
/// All processes of a run: starts those that still have something to measure, and keeps what they tell in OUT/runs.csv.
///   const std::vector<RunRow> rows = run_all(options, arguments);
#include "apps/culling_benchmark/options.h"
#include "apps/culling_benchmark/run_row.h"

namespace manzana::culling_benchmark {

/// The rows of this run's cases and structures, in the order of both and of the processes. OUT/runs.csv is whole after
/// each row; rows in it that this run would measure alike are kept. `arguments`: of this program. Throws
/// std::runtime_error when a process fails, Interrupted on a signal.
std::vector<RunRow> run_all(const Options& options, const std::vector<std::string>& arguments);

/// The other end: measures as options.process, and tells on stdout.
void run_process(const Options& options);

}  // namespace manzana::culling_benchmark
