#pragma once
/// Two ways of doing the same, timed in turn, so that what disturbs the machine disturbs both.
#include <cstdint>
#include <functional>

namespace manzana::foliage_benchmark {

struct PairTimes {
  double ms = 0, reference_ms = 0;               ///< medians
  double ratio = 0, ratio_lo = 0, ratio_hi = 0;  ///< of the reference's time to this one's: how many times as fast
  std::uint64_t pairs = 0;
};

/// Each once untimed; then pairs of both, in an order that chance decides: at least 3, and more while `seconds` last.
/// The interval is that of one process: too narrow by itself.
PairTimes time_pairs(const std::function<void()>& way, const std::function<void()>& reference, double seconds,
                     std::uint64_t seed);

}  // namespace manzana::foliage_benchmark
