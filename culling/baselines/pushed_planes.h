#pragma once
/// Planes with the rounding margin of culling/overlap.h already in them, the largest that any shape of a city can need:
/// a scan then compares with 0 and asks for no margin of its own.
///   PushedPlanes planes = push_out(narrow(frustum, origin), reach_of(boxes));
#include <array>
#include <span>

#include "culling/overlap.h"

namespace manzana::baselines {

/// A closed box: min x, y, z, max x, y, z; metres, float, relative to an origin that its owner names.
using Corners = std::array<float, 6>;
inline Corners to_corners(const culling::Box& box) {
  return {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
}

/// Where the coordinates of a corner lie in Corners.
using CornerPlaces = std::array<std::uint32_t, 3>;

/// A shape is certainly outside when it lies below dot(normal, p) + outer = 0 of some plane, and certainly on the kept
/// side of a plane when it lies above dot(normal, p) + inner = 0. A cache line each, found by a shift.
struct alignas(64) PushedPlane {
  Vec3 normal{0, 0, 0};
  float outer = 0, inner = 0;
  CornerPlaces best{}, worst{};  ///< the corner farthest along the normal, and the one least far

  float along(const Corners& box, const CornerPlaces& at) const {
    return normal.x * box[at[0]] + normal.y * box[at[1]] + normal.z * box[at[2]];
  }
  bool is_beyond(const Corners& box) const { return along(box, best) + outer < 0; }
  bool is_before(const Corners& box) const { return along(box, worst) + inner > 0; }
};

struct PushedPlanes {
  std::array<PushedPlane, 6> planes{};
  std::size_t count = 0;
  std::span<const PushedPlane> all() const { return {planes.data(), count}; }
};

/// No coordinate of the boxes is larger, axis by axis.
Vec3 reach_of(std::span<const culling::Box> boxes);

/// `reach`: no coordinate of any shape is larger (centre and radius of a sphere together).
PushedPlanes push_out(const culling::Frustum& frustum, const Vec3& reach);

}  // namespace manzana::baselines
