#pragma once
/// Points spread over triangles so that none is near another, and any first few of them are spread as well.
/// [McCool and Fiume, Hierarchical Poisson disk sampling distributions, 1992: disks shrink as room runs out]
#include <array>
#include <span>
#include <vector>

#include "culling/vec.h"

namespace manzana::foliage {

struct SurfacePoint {
  std::uint32_t triangle;  ///< which
  Vec2d place;             ///< p = a + (b - a) x + (c - a) y
};

struct PoissonOptions {
  std::uint32_t count = 16;   ///< at most
  double least_distance = 0;  ///< between any two points; 0: as far apart as there is room for `count`
  std::uint64_t seed = 1;
};

/// Distances are in space. What was reached: fewer than `count` points where least_distance leaves no room for more;
/// one where it is more than the surface is wide. A surface without area has one point, or without a least distance
/// `count`. Deterministic. Ends always: 30 tries a point [Bridson 2007], and no more points than 0.7 A /
/// least_distance^2. Cost: tries times the square of the points.
std::vector<SurfacePoint> poisson_disk(std::span<const std::array<Vec3d, 3>> triangles, const PoissonOptions& options);

}  // namespace manzana::foliage
