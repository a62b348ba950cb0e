#include "culling/baselines/view_box.h"

#include <algorithm>
#include <cmath>

namespace manzana::baselines {
namespace {

using culling::BoxD;
using culling::FrustumD;
using culling::PlaneD;

/// Relative to the eye: where two sides and the plane at a depth along the near plane's normal meet.
Vec3d corner(const PlaneD& a, const PlaneD& b, const Vec3d& forward, double depth) {
  const Vec3d edge = glm::cross(a.normal, b.normal);
  const Vec3d sum = a.offset * glm::cross(b.normal, forward) + b.offset * glm::cross(forward, a.normal) - depth * edge;
  return -sum / glm::dot(edge, forward);
}

/// The largest depth of any point of `bounds`.
double depth_of(const BoxD& bounds, const FrustumD& frustum) {
  const Vec3d& n = frustum.planes[culling::kNear].normal;
  return glm::dot(n, glm::mix(bounds.min, bounds.max, glm::greaterThan(n, Vec3d(0))) - frustum.eye);
}

}  // namespace

BoxD view_box(const FrustumD& frustum, const BoxD& bounds) {
  const double near_m = -frustum.planes[culling::kNear].offset;
  double far_m = std::max(near_m, depth_of(bounds, frustum));
  if (frustum.count > culling::kFar) far_m = std::min(far_m, frustum.planes[culling::kFar].offset);
  BoxD box;
  const auto& planes = frustum.planes;
  for (const auto x : {culling::kLeft, culling::kRight})
    for (const auto y : {culling::kBottom, culling::kTop})
      for (const double depth : {near_m, far_m}) {
        const Vec3d at = corner(planes[x], planes[y], planes[culling::kNear].normal, depth);
        if (!std::isfinite(at.x + at.y + at.z)) return bounds;
        box = merge(box, frustum.eye + at);
      }
  const Vec3d most = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double margin = 1e-8 * std::max({most.x, most.y, most.z});  // the edges are worst at 179 degrees: 1e-11
  return {glm::max(box.min - margin, bounds.min), glm::min(box.max + margin, bounds.max)};
}

}  // namespace manzana::baselines
