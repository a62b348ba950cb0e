#pragma once
/// Plots as SVG, drawn by gnuplot from scripts that stay beside them (OUT/plots/*.gp; run them in OUT).
#include <span>

#include "apps/culling_benchmark/summary.h"

namespace manzana::culling_benchmark {

struct Plot {
  std::string file, title;  ///< PLOT.svg
};

/// For each case what the frames of the flight take and find; for the paper's cities, and for the cities by number of
/// objects, time and triangles against size. Gives the plots that were drawn; without gnuplot says so on stderr, in one
/// line, and gives none.
std::vector<Plot> write_plots(const Options& options, std::span<const SummaryRow> table);

}  // namespace manzana::culling_benchmark
