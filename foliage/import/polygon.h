#pragma once
/// Polygons in space, nearly plane, as leaves of L-systems and faces of OBJ files have them.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "culling/vec.h"

namespace manzana::foliage {

/// Twice the area, along the normal; 0 for a line.  [Newell's method: Sutherland, Sproull, Schumacker, ACM Computing
/// Surveys 6(1), 1974, section on normals]
Vec3d area_vector(std::span<const Vec3d> corners);

/// Ears are cut off where it has reentrant corners; a fan from its first corner where it is convex, crosses itself, or
/// has more than 64 corners. Always corners - 2 triangles, turning as the polygon does; none for fewer than 3.
std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const Vec3d> corners);

}  // namespace manzana::foliage
