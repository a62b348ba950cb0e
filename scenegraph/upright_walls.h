#pragma once
/// What of a building stands upright, for an occlusion horizon, however its mesh is cut into triangles: those of one
/// upright plane are seen as strips, from each of their corners along the plane to the next, and a strip
/// is a wall from as low to as high as they cover it from side to side. What leans, and gables over their eaves, is
/// none.
///   const std::vector<UprightWall> walls = upright_walls(scene, building);
#include <vector>

#include "scenegraph/scene.h"

namespace manzana {

/// Metres along L's axes, from its block's origin. Seen from outside it runs from left to right.
struct UprightWall {
  Vec2 a{0, 0}, b{0, 0};
  float bottom = 0, top = 0;
  float slack = 0;      ///< by which it may be off what is drawn, in plan; at most a millimetre
  bool joined = false;  ///< it begins where the one before ends
};

/// Of a building's row; walls that continue each other follow each other.
std::vector<UprightWall> upright_walls(const Scene& scene, std::uint32_t building);

}  // namespace manzana
