#pragma once
/// Every predicate of culling, one pair of shapes each. `outside` and `inside` are certain, whatever the rounding;
/// `crosses` may be a near miss. So culling draws too much, never too little.
///   margin m = 8u (|nx cx| + |ny cy| + |nz cz| + |d| + r) with u = 2^-24; outside: s < -(r + m); inside: s > r + m
/// [numerics 2.1, 2.2]. A NaN anywhere gives `crosses`. Shapes and planes share one origin.
#include <cstdint>

#include "culling/frustum.h"
#include "culling/volumes.h"

namespace manzana::culling {

enum class Overlap : std::uint8_t { outside, crosses, inside };

Overlap overlap(const Frustum& frustum, const Sphere& sphere);
Overlap overlap(const Frustum& frustum, const Box& box);
/// A leaf of the BqR-Tree: the intersection of both, never empty because both enclose the same content. Outside when
/// either is, inside when either is.  [Pina 2009, 3.1; numerics 2.3]
Overlap overlap(const Frustum& frustum, const Sphere& sphere, const Box& box);

/// Closed sets: touching counts; empty meets nothing.  [Arvo, Graphics Gems (1990), p. 335; numerics 2.4]
bool overlaps(const Sphere& sphere, const Box& box);

}  // namespace manzana::culling
