#pragma once
/// The part of the report on growing cities. Empty when none was measured.
#include <span>

#include "apps/common/gnuplot.h"
#include "apps/culling_benchmark/summary.h"

namespace manzana::culling_benchmark {

std::string growth_text(std::span<const SummaryRow> table);
/// `growth`: time against the number of objects.
std::vector<apps::Script> growth_plots(std::span<const SummaryRow> table);

}  // namespace manzana::culling_benchmark
