#pragma once
/// One row of a plant's table of details, by each law (foliage/detail.h).
#include "foliage/leaf_lines.h"
#include "foliage/select.h"

namespace manzana::foliage {

/// What laws ask of a plant for each row.
struct LawMeasures {
  double quad_m = 0;  ///< side of a mean leaf quad; 0 without leaves
  std::vector<double>
      widths_m;       ///< of the widest line where the mesh is that of a level; the last: where there is none
  LeafLineSize thin;  ///< of leaves that may be lines
};
LawMeasures measure_for_laws(const PreparedPlant& plant);

/// Everything.
Detail show_all();
Detail show_ours(const PreparedPlant& plant, const LawMeasures& m, double error_m);
double error_of_points(const PreparedPlant& plant, double points);  ///< at which ours wants so many

/// [Gumbau 2009] A share u of the leaves, scaled to keep the crown's cover, times what is seen of a cell.
Detail show_pruned(const PreparedPlant& plant, double u);
/// [Deussen 2005, sections 10.3 and 10.4] With d' = the error: c_p A' / d'^2 points, and triangles while these are
/// fewer than three for each; q of the lines of branches that are thinner than d'.
Detail show_points_and_lines(const PreparedPlant& plant, double error_m);
/// [Gadbem 2011] The coarsest pair of mesh and lines whose lines are not wider than the error, and all points in place
/// of all triangles where a leaf is smaller than it.
Detail show_levels(const PreparedPlant& plant, const LawMeasures& m, double error_m);

/// Leaves that shrink away at the boundary cover less by half their share, so as many more are shown.
void set_leaves(Detail& d, double share, double scale);

}  // namespace manzana::foliage
