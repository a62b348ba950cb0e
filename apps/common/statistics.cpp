#include "apps/common/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace manzana::apps {
namespace {

/// How many values may be left out at either end: the largest k with P(at most k heads in n throws) <= 2.5 %.
std::size_t left_out(std::size_t n) {
  double chance = std::pow(0.5, static_cast<double>(n)), sum = 0;  // of exactly k heads, of at most k
  for (std::size_t k = 0;; ++k) {
    sum += chance;
    if (sum > 0.025) return k > 0 ? k - 1 : 0;
    chance *= static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
}

}  // namespace

double median(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

double median_ratio(std::vector<double> ratios) {
  for (double& r : ratios) r = std::log(r);
  return std::exp(median(std::move(ratios)));
}

Interval median_interval(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t skip = left_out(values.size());
  return {values[skip], values[values.size() - 1 - skip]};
}

Mean mean_of(std::span<const double> values) {
  assert(!values.empty());
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() == 1) return {mean, std::numeric_limits<double>::infinity()};
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double t = boost::math::quantile(boost::math::students_t(n - 1), 0.975);
  return {mean, t * std::sqrt(squares / (n - 1) / n)};
}

}  // namespace manzana::apps
