#include "foliage/time_budget.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

constexpr double kBandLow = 0.85, kBandHigh = 1.0;  // of the wanted time: nothing changes in between
constexpr double kFarLow = 0.6, kFarHigh = 1.3;     // beyond, few times are enough
constexpr double kAim = 0.925;
constexpr double kGain = 0.7;  // of the way, in octaves, as if all time were the trees'
constexpr double kLeastStep = 0.5, kMostStep = 1.25;

double median_of(std::array<double, TimeBudget::kMany> times, std::uint32_t n) {
  const auto middle = times.begin() + n / 2;
  std::nth_element(times.begin(), middle, times.begin() + n);
  return *middle;
}

bool between(double low, double x, double high) { return x >= low && x <= high; }

}  // namespace

void follow(TimeBudget& budget, double ms, double wanted_ms, double drawn) {
  if (!(ms > 0) || !std::isfinite(ms)) return;
  if (budget.frames++ < TimeBudget::kLag) return;
  const std::uint32_t timed = budget.frames - TimeBudget::kLag;
  budget.newest[(timed - 1) % TimeBudget::kMany] = ms;
  if (timed < TimeBudget::kFew) return;
  const double share = median_of(budget.newest, std::min(timed, TimeBudget::kMany)) / wanted_ms;
  const bool few = timed < TimeBudget::kMany;
  if (few ? between(kFarLow, share, kFarHigh) : between(kBandLow, share, kBandHigh)) return;
  const bool slow = share > kBandHigh;
  if (!slow && drawn < 0.8 * budget.vertices) return;  // it does not bind: more would only lengthen the way back
  const double from = slow ? std::min(budget.vertices, drawn) : budget.vertices;
  const double step = std::clamp(std::pow(kAim / share, kGain), kLeastStep, kMostStep);
  budget.vertices = std::clamp(from * step, TimeBudget::kFewest, TimeBudget::kMost);
  budget.frames = 0;
}

}  // namespace manzana::foliage
