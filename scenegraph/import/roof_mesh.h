#pragma once
/// Roofs over a footprint: plane facets whose heights count from the eaves, and the line along which the walls meet
/// them.
///   Roof roof = make_roof(RoofShape::gabled, footprint, triangles, 4.2);
/// Gabled, hipped and skillion roofs are the least of a few planes over the plan, given by the smallest rectangle
/// around the footprint (hipped: by the walls themselves where the outline is convex). The footprint is cut along the
/// creases, so nothing gapes whatever the outline: where an outline steps back from its rectangle, its walls rise.
/// Pyramidal roofs and domes are fans and rings about the centroid where all walls can be seen from it, and else become
/// the least of the rectangle's four planes.
#include <vector>

#include "scenegraph/import/plan_geometry.h"

namespace manzana {

/// Height above the eaves = height + dot(slope, p), metres.
struct RoofPlane {
  Vec2d slope{0, 0};
  double height = 0;
  double at(const Vec2d& p) const { return height + glm::dot(slope, p); }
};

/// A plane convex polygon, counter-clockwise from above: (x, y in plan, height above the eaves).
struct RoofFacet {
  RoofPlane plane;
  std::vector<Vec3d> corners;
};

struct Roof {
  std::vector<RoofFacet> facets;
  std::vector<RoofPlane> planes;  ///< the walls end at the least of these; none: at the eaves
};

/// Flat for footprints narrower than 1 m, whose slopes would be as steep as walls; else the shape itself.
RoofShape roof_that_fits(RoofShape shape, const Polygon& footprint);

/// `footprint` wound by plan::wind(), its corners on the plan's grid (snapped()); `triangles` its triangulation.
Roof make_roof(RoofShape shape, const Polygon& footprint, const std::vector<plan::Triangle>& triangles,
               double roof_height);

/// The rule for a roof's height where none is given, metres: a pitch of 35 degrees over half the width of the smallest
/// rectangle (skillion: 8 degrees over all of it, dome: half the width), at most 60 % of the body (`body` = from the
/// lowest floor to the ridge), and low enough to leave a storey of 2.5 m to the walls where the body has one.
double default_roof_height(RoofShape shape, const Polygon& footprint, double body);

/// Points where the top of the wall from a to b bends: (x, y, height above the eaves), a's and b's among them.
std::vector<Vec3d> wall_top(const Roof& roof, const Vec2d& a, const Vec2d& b);

/// To a grid of 2^-16 m, so that one point computed in two ways stays one point.
Vec2d snapped(const Vec2d& p);

}  // namespace manzana
