#include "foliage/lod_factor.h"

#include <algorithm>
#include <stdexcept>

namespace manzana::foliage {

PowerFactor::PowerFactor(double h) : h_(h) {
  if (!(h > 1) || !std::isfinite(h)) throw std::invalid_argument("a factor's h must be more than 1, and finite");
}

double PowerFactor::at(double z) const {
  if (!(z > 1)) return 1;
  if (std::isinf(z)) return 0;
  return std::exp2(-std::log2(z) / std::log2(h_));
}

LinearRamp::LinearRamp(double near_m, double far_m, double least) : near_(near_m), far_(far_m), least_(least) {
  if (!(near_m >= 0) || !(far_m >= near_m) || !std::isfinite(far_m))
    throw std::invalid_argument("a ramp goes from a near distance to a far one, finite, and not negative");
  if (!(least >= 0) || !(least <= 1)) throw std::invalid_argument("a ramp's least fraction must be in [0, 1]");
}

double LinearRamp::at(double distance_m) const {
  if (!(distance_m > near_)) return 1;
  if (distance_m >= far_) return least_;
  const double t = (distance_m - near_) / (far_ - near_);
  return std::max(1 - t * (1 - least_), least_);
}

std::uint64_t kept(std::uint64_t n, double lod) { return kept(n, lod, 0); }

std::uint64_t kept(std::uint64_t n, double lod, double threshold) {
  if (!(lod < 1)) return n;
  if (!(lod > 0)) return 0;
  return std::min(n, static_cast<std::uint64_t>(static_cast<double>(n) * lod + threshold));
}

}  // namespace manzana::foliage
