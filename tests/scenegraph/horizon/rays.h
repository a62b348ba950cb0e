#pragma once
/// What an eye sees by rays to it and every triangle of buildings: the truth that a horizon must keep to.
#include <array>
#include <span>
#include <vector>

#include "scenegraph/horizon.h"
#include "tests/support/random.h"

namespace manzana {

/// In L, counter-clockwise from outside.
using Triangle = std::array<Vec3d, 3>;
using Triangles = std::vector<Triangle>;

/// Of the buildings among the objects.
Triangles triangles_of(const Scene& scene, std::span<const culling::ObjectRun> objects);

culling::View looking(const Vec3d& eye, double turn);

struct Taken {
  std::size_t of = 0, gone = 0;                   ///< objects
  std::size_t buildings = 0, buildings_gone = 0;  ///< of these
  std::size_t rays = 0;
  Taken& operator+=(const Taken& other);
};
/// Of what a frustum holds a horizon takes away; of each eye another way to look.
Taken taken_away(const Scene& scene, std::span<const Vec3d> eyes);
/// And that none of some of it is seen: at corners of its box, and within.
Taken check_by_rays(const Scene& scene, std::span<const Vec3d> eyes, support::Random& random);

}  // namespace manzana
