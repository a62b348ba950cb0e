#include "culling/baselines/view_box.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace manzana::baselines {
namespace {

using culling::BoxD;
using culling::FrustumD;

/// The edges of the pyramid, from the eye to depth 1 along the near plane's normal.
std::array<Vec3d, 4> edges(const FrustumD& frustum) {
  const auto& planes = frustum.planes;
  const auto edge = [&](culling::PlaneIndex a, culling::PlaneIndex b) {
    const Vec3d along = glm::cross(planes[a].normal, planes[b].normal);
    return along / glm::dot(along, planes[culling::kNear].normal);
  };
  using namespace culling;
  return {edge(kLeft, kBottom), edge(kRight, kBottom), edge(kRight, kTop), edge(kLeft, kTop)};
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
  for (const Vec3d& edge : edges(frustum)) {
    if (!std::isfinite(edge.x + edge.y + edge.z)) return bounds;
    box = merge(merge(box, frustum.eye + edge * near_m), frustum.eye + edge * far_m);
  }
  const Vec3d most = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double margin = 1e-8 * std::max({most.x, most.y, most.z});  // the edges are worst at 179 degrees: 1e-11
  return {glm::max(box.min - margin, bounds.min), glm::min(box.max + margin, bounds.max)};
}

}  // namespace manzana::baselines
