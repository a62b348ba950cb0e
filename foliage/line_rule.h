#pragma once
/// How many lines stand for long thin things: branches, needles, blades of grass. [Deussen 2005, section 10.3]
///   const LineCounts counts = line_counts(cloud, distance, spacing_px / f_px, {});
/// Triangles and lines are in the same random order: the last `turned` of the things are lines, and of all that are
/// lines the first so many are drawn. So things turn into lines one by one, and then lines go one by one.
#include <cstdint>
#include <span>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Things with one line each.
struct LineCloud {
  double area_m2 = 0;   ///< A_l: of all their triangles, one side
  double length_m = 0;  ///< l: of all lines together
  double width_m = 0;   ///< e_l: of the widest
  std::uint64_t lines = 0;
};

struct LineRule {
  double line = 0.785398163397448;  ///< c_line: mean length on the screen over length, pi / 4; the source has 1/2
  bool gradual = true;              ///< false: the source's switch, all at once
};
inline constexpr LineRule kSourceLineRule{0.5, false};

struct LineCounts {
  double turned = 0;  ///< in [0, 1]: share of the things that are lines in place of triangles
  double drawn = 0;   ///< in [0, turned * lines]: so many lines; what is left of the whole part is how much of the next
};

/// `spacing` is d' as the tangent of an angle: pixels over f_px, f_px = height / (2 tan(fov / 2)). Lines cover d' each:
///   q = A_l / (2 c_line l r d'): that share of the lines hides what the triangles hide.
/// The source: triangles where e_l / r > d' or q >= 1, else q of the lines. Gradual: where e_l / r falls from d' to d'
/// / 2 and q from 2 to 1, for round branches the same place, triangles turn into lines; nothing jumps at any distance.
/// `turned` never falls as the distance grows, and `drawn` never rises once it is 1. r = 0 is all triangles, r =
/// infinity nothing at all. Throws std::invalid_argument for d' or c_line not above 0, and for what is negative or not
/// finite but r.
LineCounts line_counts(const LineCloud& cloud, double distance_m, double spacing, const LineRule& rule);

/// Of branches, by their ribbons.
LineCloud line_cloud(std::span<const LineSegment> lines);

}  // namespace manzana::foliage
