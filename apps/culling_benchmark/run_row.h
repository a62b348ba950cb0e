#pragma once
/// runs.csv: a row for each (case, structure, process), the record from which all the rest is made.
#include <span>

#include "apps/common/run_facts.h"

namespace manzana::culling_benchmark {

struct RunRow : apps::RunFacts, apps::Calm {
  std::string scene;  // of a file: its size and time of change; else "generated"
  std::string case_name, peer, grain;
  std::uint64_t seed = 1, process = 1, objects = 0, blocks = 0, frames = 0, timed_frames = 0, pairs = 0;
  double build_ms = 0, median_us = 0, bqr_us = 0, ratio = 1, ratio_lo = 1, ratio_hi = 1;
  std::uint64_t accepted = 0, exact = 0, missed = 0, triangles = 0, bytes = 0;
};

std::span<const apps::Column<RunRow>> run_columns();

/// All that must be equal for a row to stand for one that would be measured now.
bool same_measurement(const RunRow& a, const RunRow& b);

std::string to_csv(std::span<const RunRow> rows);
std::vector<RunRow> read_rows(std::string_view csv);

}  // namespace manzana::culling_benchmark
