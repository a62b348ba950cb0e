#pragma once
/// Plots of the cases: what each frame of a flight takes and finds, and what cities of different size do.
#include <span>

#include "apps/common/gnuplot.h"
#include "apps/culling_benchmark/summary.h"

namespace manzana::culling_benchmark {

/// path_CASE for each case, size_paper for C1 to C6, size_objects for 10k, 100k, 1M, as far as they are measured.
std::vector<apps::Script> case_plots(const Options& options, std::span<const SummaryRow> table);
std::string path_plot_name(const std::string& case_name);

/// A line, in the colour that a structure has in all plots.
std::string line_style(std::string_view peer);

}  // namespace manzana::culling_benchmark
