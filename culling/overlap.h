#pragma once
/// Every predicate of culling, one pair of shapes each. `outside` and `inside` are certain, whatever the rounding;
/// `crosses` may be a near miss. So culling draws too much, never too little.
///   margin m = 8u (|nx cx| + |ny cy| + |nz cz| + |d| + r) + slack with u = 2^-24; outside: s < -(r + m);
///   inside: s > r + m  [numerics 2.1, 2.2]
/// Shapes and planes share one origin. A NaN in a shape gives `crosses`, a plane with a NaN never culls, an empty shape
/// is outside. The tree asks sixteen shapes at once, in another way (culling/lattice.h).
#include <cstddef>
#include <cstdint>

#include "culling/frustum.h"
#include "culling/volumes.h"

namespace manzana::culling {

enum class Overlap : std::uint8_t { outside, crosses, inside };

/// Bit k: the shape is certainly on that side of plane k. Bits from the frustum's count to 7 are `inside`.
struct Sides {
  unsigned outside = 0, inside = 0;
};
inline constexpr unsigned kAllPlanes = 0xFF;

inline Overlap to_overlap(const Sides& sides) {
  if (sides.outside != 0) return Overlap::outside;
  return sides.inside == kAllPlanes ? Overlap::inside : Overlap::crosses;
}

/// Of an intersection: it is where either of its parts is.
inline Sides both(const Sides& a, const Sides& b) { return {a.outside | b.outside, a.inside | b.inside}; }

Sides sides(const Frustum& frustum, const Sphere& sphere);
Sides sides(const Frustum& frustum, const Box& box);

/// 8u: coefficients, centre, products and three sums round 6 times at most, radius and comparison twice.
inline constexpr float kMargin = 8.0F / (1 << 24);

Overlap overlap(const Frustum& frustum, const Sphere& sphere);
Overlap overlap(const Frustum& frustum, const Box& box);
/// A leaf of the BqR-Tree: the intersection of both, never empty because both enclose the same content. Outside when
/// either is, inside when for each plane either is.  [Pina 2009, 3.1; numerics 2.3]
Overlap overlap(const Frustum& frustum, const Sphere& sphere, const Box& box);

/// Whether a ball in L is certainly beyond one of the planes that have a bit in `planes`. In double, for what is at
/// another place in every frame: narrowing it would take longer than the answer.
///   margin 64 u (|c| + |e| + |d|), u = 2^-53, eye e: normals and offsets are exact to 4 units; the difference c - e,
///   products and sums round by 5 units more
bool outside(const FrustumD& frustum, unsigned planes, const SphereD& ball);

/// Closed sets: touching counts; empty meets nothing; a NaN meets everything. Computed in double, with a margin of 16
/// units of it.  [Arvo, Graphics Gems (1990), p. 335; numerics 2.4]
bool overlaps(const Sphere& sphere, const Box& box);

inline Overlap overlap(const Frustum& frustum, const Sphere& sphere) { return to_overlap(sides(frustum, sphere)); }
inline Overlap overlap(const Frustum& frustum, const Box& box) { return to_overlap(sides(frustum, box)); }
inline Overlap overlap(const Frustum& frustum, const Sphere& sphere, const Box& box) {
  return to_overlap(both(sides(frustum, sphere), sides(frustum, box)));
}

}  // namespace manzana::culling
