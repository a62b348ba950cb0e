#pragma once
/// How much of a plant's leaves is kept: a fraction by distance, and whole leaves of each cell. [Gumbau 2009, sections
/// 3 and 5]
///   const PowerFactor factor(1.5);
///   const double lod = factor.at(distance / start) * visibility;
///   const std::uint64_t leaves = kept(cell_leaves, lod, threshold);
/// All in double; what is not a number keeps all.
#include <cmath>
#include <cstdint>

namespace manzana::foliage {

/// u(z) = z^(-log_h 2) [equation 1]: z = 1 where pruning starts, u(h) = 1/2. h = sqrt 2 is a constant number of leaves
/// a pixel.
class PowerFactor {
 public:
  /// Throws std::invalid_argument unless h > 1 and finite.
  explicit PowerFactor(double h);
  double h() const { return h_; }
  /// In [0, 1], falling; 1 for z <= 1, 0 at infinity. Relative error (3 |ln u| + 4) 2^-53.
  double at(double z) const;

 private:
  double h_;
};

/// Full until `near_m`, `least` from `far_m` on, linear between: what the source runs. A step where both are one.
class LinearRamp {
 public:
  /// Throws std::invalid_argument unless 0 <= near <= far, finite, and 0 <= least <= 1.
  LinearRamp(double near_m, double far_m, double least);
  double at(double distance_m) const;  ///< in [least, 1], falling

 private:
  double near_, far_, least_;
};

/// Leaves kept of n: floor(n lod), all from lod 1 on. Growing with lod, so lists are prefixes of each other. The
/// product is rounded: n times (k / n) may be k - 1; where a count is meant, keep the count. n < 2^53.
std::uint64_t kept(std::uint64_t n, double lod);

/// The same with a threshold in [0, 1) of the cell's own: floor(n lod + threshold). Over many cells none of the leaves
/// that flooring loses is lost, so small cells do not vanish together, and trees do not change in step. All at lod 1;
/// none at lod 0.
std::uint64_t kept(std::uint64_t n, double lod, double threshold);

}  // namespace manzana::foliage
