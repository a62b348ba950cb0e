#pragma once
/// The part of the report on speed for accuracy. Empty when none was measured.
#include <span>

#include "apps/common/gnuplot.h"
#include "apps/culling_benchmark/summary.h"

namespace manzana::culling_benchmark {

std::string trade_text(std::span<const SummaryRow> table);
/// The place's name: false positives against time.
std::vector<apps::Script> trade_plots(std::span<const SummaryRow> table);

/// front.csv: the rows that are on the front, with all columns of summary.csv.
std::vector<SummaryRow> trade_front(std::span<const SummaryRow> table);

/// Whether nothing at that place is at least as quick and as accurate, and better in one.
bool on_front(std::span<const SummaryRow> table, const SummaryRow& row);

}  // namespace manzana::culling_benchmark
