#pragma once
/// Figures 5, 6, 8 and 9 of Pina 2009, ours, as scripts for gnuplot that hold their data.
#include "apps/common/gnuplot.h"
#include "apps/culling_benchmark/paper.h"

namespace manzana::paper {

/// Those of which something was measured.
std::vector<apps::Script> paper_plots(const PaperRun& run);

}  // namespace manzana::paper
