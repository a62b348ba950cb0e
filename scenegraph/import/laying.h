#pragma once
/// From a building's own frame into its block's.
///   Laying laying(site, footprint.outer[0]);
///   vertex.position = Vec3(laying.place(p));   // p: plan metres from there, height above ground
#include <algorithm>
#include <cmath>
#include <limits>

#include "scenegraph/import/meshes.h"
#include "scenegraph/import/terrain.h"

namespace manzana {

inline constexpr double kBay = 3.0;        // metres a window bay, more or less
inline constexpr double kBlindWall = 1.6;  // walls shorter than this have no window

/// A building's own frame: plan metres from `origin`, heights above ground; and the way from there to the block.
struct Laying {
  const Site& site;
  Vec2d origin;
  double foot = 0;  // of its lowest corner, over the level ground
  Mat3d normals;    // inverse transpose of d(position in the block) / d(plan, height)

  Laying(const Site& s, const Vec2d& at, double lowest) : site(s), origin(at), foot(lowest) {
    const Vec3d zero = place({0, 0, 0});
    const Mat3d linear(place({1, 0, 0}) - zero, place({0, 1, 0}) - zero, {0, 0, 1});
    normals = glm::transpose(glm::inverse(linear));
  }
  Vec3d place(const Vec3d& p) const { return ground_point(site.frame, site.block, origin + Vec2d(p), foot + p.z); }
};

/// Of the ground below those points: what stands there stands on it.
template <class Points>
double lowest_ground(const Site& site, const Points& points) {
  double lowest = std::numeric_limits<double>::infinity();
  if (site.terrain == nullptr) return 0;
  for (const auto& p : points) lowest = std::min(lowest, site.terrain->at(Vec2d(p)));
  return std::isfinite(lowest) ? lowest : 0;
}

}  // namespace manzana
