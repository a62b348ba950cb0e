#pragma once
/// The planes of one query, for boxes that are tested one at a time: the scalar trees of the benchmark.
///   const BoxPlanes planes(frustum, origin, reach);           // once a query
///   unsigned crossed = planes.crossed(box, BoxPlanes::kAll);  // kOutside, 0: inside, else the mask for what is below
#include <bit>

#include "culling/baselines/pushed_planes.h"

namespace manzana::baselines {

class BoxPlanes {
 public:
  static constexpr unsigned kAll = 0xFF, kOutside = ~0U;

  /// For shapes relative to `origin`, with no coordinate larger than `reach`.
  BoxPlanes(const culling::FrustumD& frustum, const Vec3d& origin, const Vec3& reach)
      : pushed_(push_out(narrow(frustum, origin), reach)), used_((1U << pushed_.count) - 1U) {}

  /// Bit k of the result: of the planes of `mask`, the shape may reach beyond plane k. A plane with a NaN never culls.
  unsigned crossed(const Corners& box, unsigned mask) const {
    unsigned result = 0;
    for (mask &= used_; mask != 0; mask &= mask - 1) {
      const PushedPlane& plane = pushed_.planes[static_cast<std::size_t>(std::countr_zero(mask))];
      if (plane.is_beyond(box)) return kOutside;
      if (!plane.is_before(box)) result |= mask & -mask;
    }
    return result;
  }

  unsigned crossed(const culling::Sphere& sphere, unsigned mask) const {
    unsigned result = 0;
    for (mask &= used_; mask != 0; mask &= mask - 1) {
      const PushedPlane& plane = pushed_.planes[static_cast<std::size_t>(std::countr_zero(mask))];
      const float s = glm::dot(plane.normal, sphere.center);
      if (s + plane.outer < -sphere.radius) return kOutside;
      if (!(s + plane.inner > sphere.radius)) result |= mask & -mask;
    }
    return result;
  }

  bool outside(const Corners& box, unsigned mask) const {
    for (mask &= used_; mask != 0; mask &= mask - 1)
      if (pushed_.planes[static_cast<std::size_t>(std::countr_zero(mask))].is_beyond(box)) return true;
    return false;
  }

 private:
  PushedPlanes pushed_;
  unsigned used_;
};

}  // namespace manzana::baselines
