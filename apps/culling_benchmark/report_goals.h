#pragma once
/// The parts of report.md that hold measured figures against those of goals.h. Empty without a case that has one.
#include <span>
#include <string>

#include "apps/culling_benchmark/summary.h"

namespace manzana::culling_benchmark {

/// What bqr is meant to reach, and whether it does.
std::string goals_text(std::span<const SummaryRow> table);

/// Whether the rivals are as quick as they can be.
std::string rivals_text(std::span<const SummaryRow> table);

}  // namespace manzana::culling_benchmark
