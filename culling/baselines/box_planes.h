#pragma once
/// The planes of one query, for boxes that are tested one at a time: the scalar trees of the benchmark.
///   const BoxPlanes planes(frustum, origin, reach);           // once a query
///   unsigned crossed = planes.crossed(box, BoxPlanes::kAll);  // kOutside, 0: inside, else what to ask of what is
///   below
#include <bit>

#include "culling/baselines/pushed_planes.h"

namespace manzana::baselines {

/// A closed box: min x, y, z, max x, y, z; metres, float, relative to an origin that its owner names.
using Corners = std::array<float, 6>;
inline Corners to_corners(const culling::Box& box) {
  return {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
}

class BoxPlanes {
 public:
  static constexpr unsigned kAll = 0xFF, kOutside = ~0U;

  /// For boxes relative to `origin`, with no coordinate larger than `reach`.
  BoxPlanes(const culling::FrustumD& frustum, const Vec3d& origin, const Vec3& reach) {
    const PushedPlanes pushed = push_out(narrow(frustum, origin), reach);
    for (const PushedPlane& plane : pushed.all()) {
      used_ |= 1U << count_;
      planes_[count_++] = make(plane);
    }
  }

  /// Bit k of the result: of the planes of `mask`, the box may reach beyond plane k. A plane with a NaN never culls.
  unsigned crossed(const Corners& box, unsigned mask) const {
    unsigned result = 0;
    for (mask &= used_; mask != 0; mask &= mask - 1) {
      const Plane& plane = planes_[static_cast<std::size_t>(std::countr_zero(mask))];
      if (plane.along(box, plane.best) + plane.outer < 0) return kOutside;
      if (!(plane.along(box, plane.worst) + plane.inner > 0)) result |= mask & -mask;
    }
    return result;
  }

  bool outside(const Corners& box, unsigned mask) const {
    for (mask &= used_; mask != 0; mask &= mask - 1) {
      const Plane& plane = planes_[static_cast<std::size_t>(std::countr_zero(mask))];
      if (plane.along(box, plane.best) + plane.outer < 0) return true;
    }
    return false;
  }

 private:
  /// Where the coordinates of a corner lie in Corners.
  using Places = std::array<std::uint8_t, 3>;

  struct Plane {
    Vec3 normal;
    float outer, inner;
    Places best, worst;  ///< the corner farthest along the normal, and the one least far
    float along(const Corners& box, const Places& at) const {
      return normal.x * box[at[0]] + normal.y * box[at[1]] + normal.z * box[at[2]];
    }
  };

  static Plane make(const PushedPlane& plane) {
    const auto place = [&](int axis, bool best) {
      return static_cast<std::uint8_t>(axis + ((plane.normal[axis] >= 0) == best ? 3 : 0));
    };
    const auto places = [&](bool best) { return Places{place(0, best), place(1, best), place(2, best)}; };
    return {plane.normal, plane.outer, plane.inner, places(true), places(false)};
  }

  std::array<Plane, 6> planes_;
  std::size_t count_ = 0;
  unsigned used_ = 0;
};

}  // namespace manzana::baselines
