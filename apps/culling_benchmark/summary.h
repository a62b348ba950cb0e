#pragma once
/// summary.csv: a row for each (case, structure): what the rows of all processes come to.
///   const std::vector<SummaryRow> table = summarise(options, rows);
#include <span>

#include "apps/culling_benchmark/options.h"
#include "apps/culling_benchmark/run_row.h"

namespace manzana::culling_benchmark {

/// Empty: not measured, because the structure is not available here.
struct SummaryRow {
  std::string case_name, peer, grain;
  std::optional<double> median_us, ratio;
  std::optional<std::uint64_t> accepted, exact, missed, triangles;
  std::optional<double> build_ms;
  std::optional<std::uint64_t> bytes;
  std::optional<double> ratio_lo, ratio_hi;
  std::optional<std::uint64_t> pairs, processes, frames, timed_frames, dirty, objects, blocks;
  bool measured() const { return ratio.has_value(); }
};

/// Cases and structures in the order of the options. Of several processes: the median of their medians, and the range
/// of their ratios; of one: its own interval. Processes that were disturbed in every attempt are left out while others
/// are there; `dirty` says how many were disturbed.
std::vector<SummaryRow> summarise(const Options& options, std::span<const RunRow> rows);

/// nullptr: not there, or not measured.
const SummaryRow* find_row(std::span<const SummaryRow> table, std::string_view case_name, std::string_view peer);

std::span<const apps::Column<SummaryRow>> summary_columns();
std::string to_csv(std::span<const SummaryRow> rows);

/// What must not be: objects missed, and counts that differ from process to process. A line each.
std::vector<std::string> faults(std::span<const RunRow> rows);

}  // namespace manzana::culling_benchmark
