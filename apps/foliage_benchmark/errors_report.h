#pragma once
/// Image errors as files: runs.csv, summary.csv, and their section of report.md.
#include "apps/common/csv.h"
#include "apps/common/gnuplot.h"
#include "apps/foliage_benchmark/errors.h"

namespace manzana::foliage_benchmark {

std::span<const apps::Column<ErrorRow>> error_columns();
std::span<const apps::Column<Verdict>> verdict_columns();

std::string errors_md(std::span<const Verdict> verdicts, const ErrorPlan& plan);

/// Of each plant: primitives, and each error with its floor, over the height.
std::vector<apps::Script> error_plots(std::span<const Verdict> verdicts);

}  // namespace manzana::foliage_benchmark
