#pragma once
/// A stream of random numbers, the same on every machine (culling/hash.h). Braces, not parentheses, where several are
/// drawn in one expression: only they have an order.
#include <cmath>
#include <numbers>

#include "culling/hash.h"
#include "culling/vec.h"

namespace manzana::baselines {

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  double unit() { return hash_unit(seed_, next_++); }
  double in(double low, double high) { return low + (high - low) * unit(); }
  bool chance(double p) { return unit() < p; }
  /// Evenly spread over the exponents.
  double scale(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }
  std::uint64_t below(std::uint64_t n) { return hash_bits(seed_, next_++) % n; }
  /// On the unit sphere.
  Vec3d direction() {
    const double z = in(-1, 1);
    const double a = in(-std::numbers::pi, std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
  }

 private:
  std::uint64_t seed_, next_ = 0;
};

}  // namespace manzana::baselines
