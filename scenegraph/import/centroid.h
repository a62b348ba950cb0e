#pragma once
/// The geometric centre of a block's ground.  [numerics 5]
#include <algorithm>
#include <span>

#include "scenegraph/import/features.h"

namespace manzana {

/// Closed box in plan, metres. Empty when lo > hi, and so by default.
struct PlanBox {
  Vec2d lo{1, 1}, hi{0, 0};
  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y); }
  void add(const Vec2d& p);
  Vec2d center() const { return 0.5 * lo + 0.5 * hi; }  ///< never overflows
  double half_size() const { return std::max(0.5 * hi.x - 0.5 * lo.x, 0.5 * hi.y - 0.5 * lo.y); }
  double size() const { return 2 * half_size(); }  ///< the longer side
  bool contains(const Vec2d& p) const { return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y; }
};
PlanBox box_of(std::span<const Vec2d> points);

struct Centroid {
  Vec2d center{0, 0};
  double area = 0;          ///< of the outer ring less its holes, square metres, never negative
  bool box_center = false;  ///< the outline has no usable area: `center` is its box's centre
};

/// Area centroid of an outline with holes; rings in either direction, a last point equal to the first is allowed.
/// Coordinates are taken relative to the first point, so the error stays at a unit in the last place of the coordinates
/// (1e-9 m at 5000 km). The box's centre where the area is under 1e-12 of the squared diagonal, or the centroid falls
/// outside the box (outlines that cross themselves). May lie outside a U-shaped outline. No point: the origin.
Centroid centroid(const Polygon& outline);

}  // namespace manzana
