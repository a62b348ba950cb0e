#include "culling/overlap.h"

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstddef>

namespace manzana::culling {
namespace {

/// Signed distance of a point, and the margin of its rounding.
struct Signed {
  float s, m;
};
Signed signed_distance(const Plane& plane, float slack, const Vec3& p) {
  const Vec3 terms = plane.normal * p;
  const Vec3 sizes = glm::abs(terms);
  return {terms.x + terms.y + terms.z + plane.offset,
          kMargin * (sizes.x + sizes.y + sizes.z + glm::abs(plane.offset)) + slack};
}

/// The corner of the box that is farthest along n.
Vec3 corner_along(const Box& box, const Vec3& n) {
  return {n.x >= 0 ? box.max.x : box.min.x, n.y >= 0 ? box.max.y : box.min.y, n.z >= 0 ? box.max.z : box.min.z};
}

bool is_nan(const Box& box) { return glm::any(glm::isnan(box.min)) || glm::any(glm::isnan(box.max)); }

/// What fills the bits that have no plane.
Sides no_planes(const Frustum& frustum) { return {0, kAllPlanes & ~((1U << frustum.count) - 1U)}; }

void set(unsigned& bits, std::size_t k, bool value) { bits |= value ? 1U << k : 0U; }

}  // namespace

Sides sides(const Frustum& frustum, const Sphere& sphere) {
  if (sphere.empty()) return {kAllPlanes, 0};
  const float r = sphere.radius + kMargin * sphere.radius;
  Sides all = no_planes(frustum);
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const Signed at = signed_distance(frustum.planes[k], frustum.slack[k], sphere.center);
    set(all.outside, k, at.s < -(r + at.m));
    set(all.inside, k, at.s > r + at.m);
  }
  return all;
}

Sides sides(const Frustum& frustum, const Box& box) {
  if (is_nan(box)) return no_planes(frustum);  // before empty(): a NaN makes a box seem empty
  if (box.empty()) return {kAllPlanes, 0};
  Sides all = no_planes(frustum);
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const Plane& plane = frustum.planes[k];
    const Signed best = signed_distance(plane, frustum.slack[k], corner_along(box, plane.normal));
    const Signed worst = signed_distance(plane, frustum.slack[k], corner_along(box, -plane.normal));
    set(all.outside, k, best.s < -best.m);
    set(all.inside, k, worst.s > worst.m);
  }
  return all;
}

bool outside(const FrustumD& frustum, unsigned planes, const SphereD& ball) {
  if (ball.empty()) return true;
  const Vec3d at = ball.center - frustum.eye, sizes = glm::abs(ball.center) + glm::abs(frustum.eye);
  const double size = sizes.x + sizes.y + sizes.z + ball.radius;
  for (planes &= (1U << frustum.count) - 1U; planes != 0; planes &= planes - 1) {
    const PlaneD& plane = frustum.planes[static_cast<std::size_t>(std::countr_zero(planes))];
    const double margin = 32 * DBL_EPSILON * (size + std::abs(plane.offset));
    if (glm::dot(plane.normal, at) + plane.offset < -(ball.radius + margin)) return true;
  }
  return false;
}

bool overlaps(const Sphere& sphere, const Box& box) {
  if (sphere.empty()) return false;
  if (box.empty()) return is_nan(box);
  // Squares of floats neither overflow nor vanish in double.
  const Vec3d c(sphere.center);
  const Vec3d gap = c - glm::clamp(c, Vec3d(box.min), Vec3d(box.max));
  const double r = static_cast<double>(sphere.radius);
  return !(glm::dot(gap, gap) > r * r * (1 + 8 * DBL_EPSILON));
}

}  // namespace manzana::culling
