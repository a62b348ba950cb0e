#pragma once
/// Points or lines: which of them look like a leaf from afar is told by its shape. [Deussen 2005, section 10.6 hopes
/// for such an analysis; there the user chooses]
#include <span>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

struct LeafForm {
  double length = 0;  ///< m, of the box's longest side
  double width = 0;   ///< m: area over length, so a hand of five narrow fingers is wide, and a bent blade narrow
  Vec3d axis{0, 0, 1};
  bool thin() const { return length >= 8 * width; }  ///< lines are better: a blade of grass, a needle
};

/// Of all quads of one leaf; `alpha`: the share of them that is not air. The box must be slim as well: a ring of wire
/// is not a line. Throws as fit_box() does.
LeafForm leaf_form(std::span<const PlantQuad> quads, double alpha);

/// A quad of a thin leaf as a ribbon along `axis`, as wide as it is, times alpha; plant_lines.vert turns it.
LineSegment leaf_line(const PlantQuad& quad, const Vec3d& axis, double alpha);

}  // namespace manzana::foliage
