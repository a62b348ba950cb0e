#pragma once
/// Every predicate of culling, one pair of shapes each. `outside` and `inside` are certain, whatever the rounding;
/// `crosses` may be a near miss. So culling draws too much, never too little.
///   margin m = 8u (|nx cx| + |ny cy| + |nz cz| + |d| + r) + slack with u = 2^-24; outside: s < -(r + m);
///   inside: s > r + m  [numerics 2.1, 2.2]
/// Shapes and planes share one origin. A NaN in a shape gives `crosses`, a plane with a NaN never culls, an empty shape
/// is outside. Inline, because a query asks thousands of times.
#include <cstddef>
#include <cstdint>

#include "culling/frustum.h"
#include "culling/volumes.h"

namespace manzana::culling {

enum class Overlap : std::uint8_t { outside, crosses, inside };

/// 8u: coefficients, centre, products and three sums round 6 times at most, radius and comparison twice.
inline constexpr float kMargin = 8.0F / (1 << 24);

Overlap overlap(const Frustum& frustum, const Sphere& sphere);
Overlap overlap(const Frustum& frustum, const Box& box);
/// A leaf of the BqR-Tree: the intersection of both, never empty because both enclose the same content. Outside when
/// either is, inside when either is.  [Pina 2009, 3.1; numerics 2.3]
Overlap overlap(const Frustum& frustum, const Sphere& sphere, const Box& box);

/// Closed sets: touching counts; empty meets nothing; a NaN meets everything. Computed in double, with a margin of 16
/// units of it.  [Arvo, Graphics Gems (1990), p. 335; numerics 2.4]
bool overlaps(const Sphere& sphere, const Box& box);

/// What a box with empty() is to any frustum: outside, or crosses when it is a NaN that made it seem empty.
Overlap overlap_of_empty(const Box& box);

/// Signed distance of a point and the margin of its rounding.
struct Signed {
  float s, m;
};
inline Signed signed_distance(const Plane& plane, float slack, const Vec3& p) {
  const Vec3 terms = plane.normal * p;
  const Vec3 sizes = glm::abs(terms);
  return {terms.x + terms.y + terms.z + plane.offset,
          kMargin * (sizes.x + sizes.y + sizes.z + glm::abs(plane.offset)) + slack};
}

inline Overlap overlap(const Frustum& frustum, const Sphere& sphere) {
  if (sphere.empty()) return Overlap::outside;
  const float r = sphere.radius + kMargin * sphere.radius;
  bool inside = true;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const Signed at = signed_distance(frustum.planes[k], frustum.slack[k], sphere.center);
    if (at.s < -(r + at.m)) return Overlap::outside;
    inside = inside && at.s > r + at.m;
  }
  return inside ? Overlap::inside : Overlap::crosses;
}

/// The corner of the box that is farthest along n.
inline Vec3 corner_along(const Box& box, const Vec3& n) {
  return {n.x >= 0 ? box.max.x : box.min.x, n.y >= 0 ? box.max.y : box.min.y, n.z >= 0 ? box.max.z : box.min.z};
}

inline Overlap overlap(const Frustum& frustum, const Box& box) {
  if (box.empty()) return overlap_of_empty(box);
  bool inside = true;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const Plane& plane = frustum.planes[k];
    const Signed best = signed_distance(plane, frustum.slack[k], corner_along(box, plane.normal));
    if (best.s < -best.m) return Overlap::outside;
    if (!inside) continue;
    const Signed worst = signed_distance(plane, frustum.slack[k], corner_along(box, -plane.normal));
    inside = worst.s > worst.m;
  }
  return inside ? Overlap::inside : Overlap::crosses;
}

inline Overlap overlap(const Frustum& frustum, const Sphere& sphere, const Box& box) {
  const Overlap ball = overlap(frustum, sphere);
  return ball == Overlap::crosses ? overlap(frustum, box) : ball;
}

}  // namespace manzana::culling
