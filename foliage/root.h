#pragma once
/// Factors that are fitted to what is covered.
#include <algorithm>
#include <cmath>

namespace manzana::foliage {

/// Where a growing function is 0, between `least` and `most`; an end where it is not. By false position over the
/// logarithm, kept off the ends.
template <class Function>  // double(float)
float root(float least, float most, Function&& function) {
  constexpr double kNear = 0.0005;  // of the coverage: a third of what 500 000 pixels scatter
  const auto at = [&](double exponent) { return function(static_cast<float>(std::exp2(exponent))); };
  const double end = std::log2(static_cast<double>(most));
  double low = std::log2(static_cast<double>(least)), high = low, below = at(low), above = below;
  if (below >= 0) return least;
  while (above < 0 && high < end) {
    low = high, below = above;
    high = std::min(high + 0.25, end);
    above = at(high);
  }
  if (above <= 0) return most;
  for (int round = 0; round < 6; ++round) {
    const double middle = low + (high - low) * std::clamp(-below / (above - below), 0.1, 0.9), value = at(middle);
    (value < 0 ? low : high) = middle;
    (value < 0 ? below : above) = value;
    if (std::abs(value) < kNear) return static_cast<float>(std::exp2(middle));
  }
  return static_cast<float>(std::exp2(low + (high - low) * -below / (above - below)));
}

}  // namespace manzana::foliage
