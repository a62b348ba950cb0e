// Means and bounds of what was measured, what of it is on the front, and the profiles of quality.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "apps/common/statistics.h"
#include "apps/foliage_benchmark/trade.h"

namespace manzana::foliage_benchmark {
namespace {

/// The rows of plants once more, as rows of one plant.
std::vector<ErrorRow> with_all_plants(std::span<const ErrorRow> rows) {
  std::vector<ErrorRow> all(rows.begin(), rows.end());
  for (ErrorRow row : rows) {
    if (is_stand(row.plant)) continue;
    row.plant = kAllPlants;
    all.push_back(std::move(row));
  }
  return all;
}

void set_bounds(std::span<const ErrorRow> rows, TradePoint& point) {
  const auto bound = [&](double ErrorRow::*error) {
    std::vector<double> values;
    for (const ErrorRow& row : rows)
      if (same_kind(row, point)) values.push_back(row.*error);
    point.views = values.size();
    return apps::mean_of(values).within;
  };
  point.cover_within = bound(&ErrorRow::cover);
  point.colour_within = bound(&ErrorRow::colour);
  point.ssim_within = bound(&ErrorRow::ssim);
  point.gmsd_within = bound(&ErrorRow::gmsd);
}

void set_pop(std::span<const StepRow> steps, TradePoint& point) {
  for (const StepRow& row : steps) {
    const bool of_it = row.plant == point.plant || (point.plant == kAllPlants && !is_stand(row.plant));
    if (of_it && row.height_px == point.height_px && same_way(row, point))
      point.pop = std::max(point.pop.value_or(0), pop_of(row));
  }
}

void set_costs(std::span<const Verdict> verdicts, const Times& times, TradePoint& point) {
  for (const Verdict& full : verdicts)
    if (full.law == "full" && full.sampling == "product" && full.plant == point.plant &&
        full.height_px == point.height_px)
      point.primitives_ratio =
          static_cast<double>(point.primitives) / std::max(1.0, static_cast<double>(full.primitives));
  for (const TimeRow& row : times.rows)
    if (row.plant == point.plant && row.table == kTradeTable && row.way == cost_key(point, point.height_px))
      point.ratio = row.ratio, point.ratio_lo = row.ratio_lo, point.ratio_hi = row.ratio_hi;
}

/// How far from perfect, and by how much that may be off; what was not measured is perfect.
std::array<apps::Mean, 5> errors_of(const TradePoint& p) {
  return {{{std::abs(p.cover - 1), p.cover_within},
           {p.colour, p.colour_within},
           {1 - p.ssim, p.ssim_within},
           {p.gmsd, p.gmsd_within},
           {p.pop.value_or(0), 0}}};
}

/// No worse in anything, and better in one by more than is in doubt.
bool beats(const TradePoint& a, const TradePoint& b) {
  if (a.plant != b.plant || a.height_px != b.height_px || a.primitives > b.primitives) return false;
  bool better = a.primitives < b.primitives;
  const auto of_a = errors_of(a), of_b = errors_of(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (of_a[i].mean > of_b[i].mean) return false;
    better |= of_a[i].mean + std::max(of_a[i].within, of_b[i].within) < of_b[i].mean;
  }
  return better;
}

/// Of mosaics and groves, as the walkthrough has them.
bool has_usual_knobs(const ErrorRow& row) {
  ErrorRow usual;
  set_way({foliage::Law::ours, row.error_px, FarKnobs{}}, usual);
  return same_way(row, usual);
}

}  // namespace

bool is_stand(std::string_view name) { return name.starts_with("stand, ") || name == kWood; }

std::vector<TradePoint> trade_points(std::span<const ErrorRow> rows, std::span<const StepRow> steps,
                                     const Times& times) {
  const std::vector<ErrorRow> all = with_all_plants(rows);
  const std::vector<Verdict> verdicts = judge(all);
  std::vector<TradePoint> points;
  for (const Verdict& verdict : verdicts) {
    const bool one_sample = verdict.law == "full" && verdict.sampling == "single";
    if (!one_sample && (verdict.law == "full" || verdict.sampling != "fine")) continue;
    TradePoint& point = points.emplace_back();
    static_cast<Verdict&>(point) = verdict;
    set_bounds(all, point);
    set_pop(steps, point);
    set_costs(verdicts, times, point);
  }
  for (TradePoint& point : points)
    if (point.law != "full" &&
        std::ranges::none_of(points, [&](const TradePoint& p) { return p.law != "full" && beats(p, point); }))
      point.front = "front";
  return points;
}

double worst_over(const TradePoint& p, double allowed) {
  const std::array limits{allowed * kCoverWithin, allowed * kColourWithin, allowed * (1 - p.floor_ssim),
                          allowed * p.floor_gmsd, kMostPop};
  const auto errors = errors_of(p);
  double worst = 0;
  for (std::size_t i = 0; i < limits.size(); ++i)
    worst = std::max(worst, (errors[i].mean + errors[i].within) / limits[i]);
  return worst;
}

std::vector<Profile> choose_profiles(std::vector<TradePoint>& points) {
  struct OfWay {
    double worst = 0, log_ratio = 0;
    int places = 0;
  };
  std::vector<Profile> profiles{{"fast", 2}, {"balanced", 1}, {"accurate", 0.5}};
  for (Profile& profile : profiles) {
    std::map<std::pair<std::string, double>, OfWay> ways;
    double single = 0;
    for (const TradePoint& p : points) {
      if (p.plant != kAllPlants) continue;
      if (p.law == "full") {
        single = std::max(single, worst_over(p, profile.allowed));
        continue;
      }
      OfWay& way = ways[{p.law, p.error_px}];
      way.worst = std::max(way.worst, worst_over(p, profile.allowed));
      way.log_ratio += std::log(std::max(p.primitives_ratio, 1e-9));
      ++way.places;
    }
    profile.samples = single <= 1 ? 1 : profile.allowed >= 1 ? 4 : 8;
    for (const auto& [key, way] : ways) {
      const double ratio = std::exp(way.log_ratio / way.places);
      if (way.worst > 1 || ratio >= profile.primitives_ratio) continue;
      profile.law = key.first, profile.error_px = key.second, profile.primitives_ratio = ratio;
    }
    for (TradePoint& p : points)
      if (p.law == profile.law && p.error_px == profile.error_px && (p.plant != kWood || has_usual_knobs(p)))
        p.profiles += (p.profiles.empty() ? "" : " ") + profile.name;
  }
  return profiles;
}

}  // namespace manzana::foliage_benchmark
