#pragma once
/// One process of a run: builds every case and every structure, checks their answers and times them.
///   measure(options, finished, tell);
#include <functional>

#include "apps/culling_benchmark/options.h"
#include "apps/culling_benchmark/run_row.h"

namespace manzana::culling_benchmark {

/// Called as the work goes on.
struct Tell {
  std::function<void(const RunRow&)> row;
  std::function<void(const std::string& stage, double fraction, double seconds_left)> progress;
};

/// Rows that are in `finished` are not measured again. The first process also writes, for each row and before it is
/// told, OUT/frames/CASE_PEER.csv with what each frame took. Throws as make_workload does.
void measure(const Options& options, std::span<const RunRow> finished, const Tell& tell);

/// What that takes by the rules: what the finished rows took is not in it.
double expected_seconds(const Options& options, int process, std::span<const RunRow> finished);

/// What the row of a measurement that is still to be made will have in common with a finished one.
RunRow expected_row(const Options& options, const std::string& case_name, std::string_view peer, int process);
bool is_finished(std::span<const RunRow> finished, const RunRow& expected);

/// A name for files: of a path its last part; letters, digits, dots and dashes are kept.
std::string file_name(const std::string& case_name);

}  // namespace manzana::culling_benchmark
