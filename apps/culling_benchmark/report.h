#pragma once
/// report.md: what a reader wants to know, in tables.
#include <span>

#include "apps/culling_benchmark/summary.h"

namespace manzana::culling_benchmark {

/// `wrong`: the lines of faults(). `plots`: the names of those that are drawn.
std::string report_md(const Options& options, std::span<const SummaryRow> table, std::span<const std::string> wrong,
                      std::span<const std::string> plots);

}  // namespace manzana::culling_benchmark
