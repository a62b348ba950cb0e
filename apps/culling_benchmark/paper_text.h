#pragma once
/// The part of report.md about Pina 2009: its tables with ours beside them, and in words where they differ and why.
#include "apps/culling_benchmark/paper_grain.h"
#include "apps/culling_benchmark/paper_rows.h"

namespace manzana::paper {

/// `plots`: names of those that were drawn, as NAME.svg beside the report.
std::string paper_text(const PaperRun& run, std::span<const PaperRow> rows, const GrainTable& grains,
                       std::span<const std::string> plots);

}  // namespace manzana::paper
