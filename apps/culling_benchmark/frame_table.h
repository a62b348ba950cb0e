#pragma once
/// frames/CASE_PEER.csv: what each frame of a flight took, from the first process.
#include <span>

#include "apps/common/csv.h"
#include "apps/culling_benchmark/timing.h"
#include "apps/culling_benchmark/truth.h"

namespace manzana::culling_benchmark {

struct FrameRow {
  std::uint64_t frame = 0;
  std::optional<double> us;
  std::uint64_t accepted = 0, exact = 0, triangles = 0;
};

std::span<const apps::Column<FrameRow>> frame_columns();
std::vector<FrameRow> frame_table(const std::vector<Counts>& counts, const Plan& plan, const PairTimes& times);
std::string to_csv(std::span<const FrameRow> rows);

}  // namespace manzana::culling_benchmark
