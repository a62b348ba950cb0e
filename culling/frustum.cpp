#include "culling/frustum.h"

#include <algorithm>
#include <cassert>
#include <cfloat>
#include <cmath>

namespace manzana::culling {
namespace {

constexpr double kUnit = DBL_EPSILON / 2;
constexpr double kReach = 1e7;  // metres from the origin to any shape; the earth is not larger

bool finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double largest(const Vec3d& v) { return glm::max(std::abs(v.x), glm::max(std::abs(v.y), std::abs(v.z))); }

/// Divided by the largest part first, because the square of a length under- or overflows.
Vec3d unit(const Vec3d& v) {
  const double scale = largest(v);
  if (!(scale > 0)) return {0, 0, 0};
  return glm::normalize(v / scale);
}

/// A unit vector orthogonal to the unit vector `forward`, in the plane's right hand seen along `up`.
Vec3d right_of(const Vec3d& forward, const Vec3d& up) {
  Vec3d side = glm::cross(forward, unit(up));
  if (!(glm::length(side) > 1e-6)) {
    side = glm::cross(forward, Vec3d(0, 0, 1));
    if (!(glm::length(side) > 1e-6)) side = glm::cross(forward, Vec3d(0, 1, 0));
  }
  side = unit(side);
  // A short cross product is mostly rounding: once more, orthogonal.
  return unit(side - glm::dot(side, forward) * forward);
}

/// The plane through the eye that holds sign * (side - tangent * forward) >= 0. Divided by the larger part first, so
/// that no square overflows; std::hypot is as good, but a frame comes to the library's code cold, and waits 2 us for
/// it.
PlaneD side_plane(const Vec3d& side, const Vec3d& forward, double tangent, double sign) {
  const double larger = std::max(1.0, std::abs(tangent)), a = 1 / larger, b = tangent / larger;
  const Vec3d normal = sign * (a * side - b * forward) / std::sqrt(a * a + b * b);
  return finite(normal) ? PlaneD{normal, 0} : kNoPlane;
}

}  // namespace

View look(const Vec3d& eye, const Vec3d& forward, const Vec3d& up, double fovy, double aspect, double near_m,
          double far_m) {
  assert(finite(eye) && finite(forward) && finite(up) && largest(forward) > 0);
  assert(fovy > 0 && aspect > 0 && near_m > 0 && far_m > near_m);
  View view;
  view.eye = eye;
  view.forward = unit(forward);
  view.right = right_of(view.forward, up);
  view.up = glm::cross(view.right, view.forward);
  view.tan_top = std::tan(fovy / 2);
  view.tan_right = aspect * view.tan_top;
  view.tan_bottom = -view.tan_top;
  view.tan_left = -view.tan_right;
  view.near_m = near_m;
  view.far_m = far_m;
  return view;
}

FrustumD make_frustum(const View& view) {
  FrustumD f;
  f.eye = view.eye;
  f.planes[kLeft] = side_plane(view.right, view.forward, view.tan_left, 1);
  f.planes[kRight] = side_plane(view.right, view.forward, view.tan_right, -1);
  f.planes[kBottom] = side_plane(view.up, view.forward, view.tan_bottom, 1);
  f.planes[kTop] = side_plane(view.up, view.forward, view.tan_top, -1);
  f.planes[kNear] = {view.forward, -view.near_m};
  f.count = 5;
  if (std::isfinite(view.far_m)) f.planes[static_cast<std::size_t>(f.count++)] = {-view.forward, view.far_m};
  return f;
}

Frustum narrow(const FrustumD& frustum, const Vec3d& origin) {
  const Vec3d shift = origin - frustum.eye;
  Frustum f;
  f.count = frustum.count;
  for (std::size_t k = 0; k < static_cast<std::size_t>(f.count); ++k) {
    const PlaneD& p = frustum.planes[k];
    f.planes[k] = {Vec3(p.normal), static_cast<float>(glm::dot(p.normal, shift) + p.offset)};
    // The normal is off by 4 units of double in any direction, so by that much of every distance along the plane.
    f.slack[k] = static_cast<float>(8 * kUnit * (largest(shift) * 3 + std::abs(p.offset) + kReach));
  }
  return f;
}

}  // namespace manzana::culling
