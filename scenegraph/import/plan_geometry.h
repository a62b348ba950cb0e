#pragma once
/// Rings and polygons in plan, metres: what walls, roofs and greens are cut from. Rings are open. All in double;
/// callers subtract an origin near the shape first.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "scenegraph/import/geos.h"

namespace manzana::plan {

using Ring = std::vector<Vec2d>;
using Triangle = std::array<Vec2d, 3>;

inline double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }
inline Vec2d left_of(const Vec2d& d) { return {-d.y, d.x}; }
/// Twice the signed area; positive for counter-clockwise.
inline double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) { return cross(b - a, c - a); }

bool finite(std::span<const Vec2d> points);
/// Signed area, m2; positive for counter-clockwise.
double area(std::span<const Vec2d> ring);
double area(const Polygon& shape);  ///< of the outline without its holes, never negative
Vec2d centroid(std::span<const Vec2d> ring);
/// Strictly: every corner turns left, and the ring goes round once.
bool strictly_convex(std::span<const Vec2d> ring);
/// Every edge is seen counter-clockwise from `eye`.
bool star_shaped_from(std::span<const Vec2d> ring, const Vec2d& eye);
/// Counter-clockwise, without collinear points.  [Andrew 1979, monotone chain]
Ring convex_hull(Ring points);

/// center +- along * half_length +- left_of(along) * half_width; half_length >= half_width.
struct OrientedBox {
  Vec2d center{0, 0}, along{1, 0};
  double half_length = 0, half_width = 0;
};
/// The enclosing rectangle of least area; it has a side on the hull.  [Freeman and Shapira 1975]
OrientedBox smallest_rectangle(std::span<const Vec2d> ring);

/// Without points that repeat (within 1 mm) or lie on a straight wall (within 1 cm and about 1 degree).
Ring simplified(std::span<const Vec2d> ring);
/// Outline counter-clockwise, holes clockwise: the inside is on the left everywhere.
void wind(Polygon& shape);

/// Counter-clockwise triangles that use the polygon's corners and no others; empty when GEOS refuses. Constrained
/// Delaunay, or a fan where the outline is strictly convex.
std::vector<Triangle> triangulate(const Geos& geos, const Polygon& shape);

}  // namespace manzana::plan
