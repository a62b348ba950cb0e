#pragma once
/// What a camera must not go through: walls and trunks.
///   Obstacles obstacles(scene);
///   if (obstacles.inside_building({x, y, 1.7})) ...
#include "apps/walkthrough/plan_grid.h"
#include "scenegraph/scene.h"

namespace manzana::walkthrough {

/// Points are (x, y, height above ground). Refers to the scene.
class Obstacles {
 public:
  explicit Obstacles(const Scene& scene);  ///< O(n log n)

  /// Exact on the triangles: an odd number of roofs and floors straight above the point. So the space under a building
  /// that begins higher up is outside.
  bool inside_building(const Vec3d& point) const;

  /// Not inside a building there or `margin` metres to any side, and no trunk nearer than that.
  bool clear(const Vec3d& point, double margin) const;

  /// How much of the straight way lies inside buildings, in metres.
  double buried_length(const Vec3d& from, const Vec3d& to) const;

  /// Top of the highest building within `radius` metres of the way from a to b, above ground; 0 without any.
  double highest_roof(const Vec2d& a, const Vec2d& b, double radius) const;

 private:
  bool covers(std::uint32_t building, const Vec3d& local) const;
  bool trunk_near(const Vec2d& plan, double margin) const;

  const Scene& scene_;
  PlanGrid buildings_, trees_;
};

}  // namespace manzana::walkthrough
