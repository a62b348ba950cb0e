#pragma once
/// From a building's own frame into its block's.
///   Laying laying(site, footprint.outer[0]);
///   vertex.position = Vec3(laying.place(p));   // p: plan metres from there, height above ground
#include "scenegraph/import/meshes.h"

namespace manzana {

inline constexpr double kBay = 3.0;        // metres a window bay, more or less
inline constexpr double kBlindWall = 1.6;  // walls shorter than this have no window

/// A building's own frame: plan metres from `origin`, heights above ground; and the way from there to the block.
struct Laying {
  const Site& site;
  Vec2d origin;
  Mat3d normals;  // inverse transpose of d(position in the block) / d(plan, height)

  Laying(const Site& s, const Vec2d& at) : site(s), origin(at) {
    const Vec3d foot = place({0, 0, 0});
    const Mat3d linear(place({1, 0, 0}) - foot, place({0, 1, 0}) - foot, {0, 0, 1});
    normals = glm::transpose(glm::inverse(linear));
  }
  Vec3d place(const Vec3d& p) const { return ground_point(site.frame, site.block, origin + Vec2d(p), p.z); }
};

}  // namespace manzana
