#pragma once
/// How many points stand for a plant's leaves, and how triangles turn into them. [Deussen 2005, sections 10.3 and 10.4]
///   const double p = points_wanted(leaf_area, distance, f_px, {});
///   const PointCounts counts = point_counts(p, triangles, threshold);
/// Triangles and points are in the same random order, two points a triangle: the first `triangles` triangles are drawn,
/// and of the other triangles' points the first `points`.
#include <cstdint>

namespace manzana::foliage {

/// Two knobs that the source keeps apart: how dense points lie, and how large they are drawn (not less than spacing_px;
/// a matter of drawing alone).
struct PointRule {
  double c_p = 1.2;         ///< points for each square of spacing_px that the leaves cover
  double spacing_px = 1.5;  ///< d'
  double near_m = 0.1;      ///< distances are not taken to be less
};

/// p = c_p A' / d'^2, where A' = f_px^2 A / (2 r^2): the area of leaves on the screen in square pixels, half of it
/// since leaves are turned in all directions. f_px = height / (2 tan(fov / 2)). May be huge, never cast it: r = 0.1 m
/// gives 3e10. Throws std::invalid_argument unless spacing and c_p are more than 0 and all is finite.
double points_wanted(double leaf_area_m2, double distance_m, double f_px, const PointRule& rule);

struct PointCounts {
  std::uint64_t triangles = 0, points = 0;
  std::uint64_t vertices() const { return 3 * triangles + points; }
};

/// Of k triangles, less than 2^60. Exactly floor(min(p, 3 k)) vertices from p = 1 on: all triangles from 3 k on, points
/// alone up to 2 k. Below 1 one point with probability p: where the plant's threshold in [0, 1) is less. Growing with
/// p. What is not a number draws all triangles.
PointCounts point_counts(double p, std::uint64_t triangles, double threshold);

}  // namespace manzana::foliage
