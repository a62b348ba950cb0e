#pragma once
/// The trade as files: summary.csv, front.csv, quality.csv, and its section of report.md.
#include "apps/common/csv.h"
#include "apps/common/gnuplot.h"
#include "apps/foliage_benchmark/trade.h"

namespace manzana::foliage_benchmark {

std::span<const apps::Column<TradePoint>> trade_columns();

/// What scenegraph/draw/quality.csv holds.
std::string quality_csv(std::span<const Profile> profiles);

std::string trade_md(std::span<const TradePoint> points, std::span<const Profile> profiles, const TradePlan& plan);

/// Of each plant and stand: every error over the share of all detail's primitives.
std::vector<apps::Script> trade_plots(std::span<const TradePoint> points);

}  // namespace manzana::foliage_benchmark
