#pragma once
/// report.md: what a reader wants to know, in tables.
#include "apps/culling_benchmark/plots.h"

namespace manzana::culling_benchmark {

/// `wrong`: the lines of faults().
std::string report_md(const Options& options, std::span<const SummaryRow> table, std::span<const std::string> wrong,
                      std::span<const Plot> plots);

}  // namespace manzana::culling_benchmark
