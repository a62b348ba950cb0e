#include "apps/foliage_benchmark/pair_times.h"

#include <vector>

#include "apps/common/clock.h"
#include "apps/common/statistics.h"
#include "culling/hash.h"

namespace manzana::foliage_benchmark {
namespace {

constexpr std::uint64_t kLeastPairs = 3, kMostPairs = 50;

double timed_ms(const std::function<void()>& work) {
  const auto start = apps::Clock::now();
  work();
  return apps::us_since(start) / 1000;
}

}  // namespace

PairTimes time_pairs(const std::function<void()>& way, const std::function<void()>& reference, double seconds,
                     std::uint64_t seed) {
  way();
  reference();
  std::vector<double> ways, references, ratios;
  const auto start = apps::Clock::now();
  while (ratios.size() < kLeastPairs || (ratios.size() < kMostPairs && apps::us_since(start) < seconds * 1e6)) {
    const bool way_first = hash_bits(seed, ratios.size()) % 2 == 0;
    if (way_first) ways.push_back(timed_ms(way));
    references.push_back(timed_ms(reference));
    if (!way_first) ways.push_back(timed_ms(way));
    ratios.push_back(references.back() / ways.back());
  }
  const apps::Interval interval = apps::median_interval(ratios);
  return {apps::median(ways), apps::median(references), apps::median_ratio(ratios), interval.low, interval.high,
          ratios.size()};
}

}  // namespace manzana::foliage_benchmark
