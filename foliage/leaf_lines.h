#pragma once
/// Thin leaves as lines: blades of grass, needles. From afar a ribbon as wide as the leaf looks from there is what is
/// seen of it, and quads thinner than a pixel fall apart; from still farther, where even its length is a pixel or two,
/// points do. [Deussen 2005, sections 10.3 and 10.6]
#include <span>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Puts them behind the branches' lines; and in every level behind the branches' of that level the first so many, and
/// as much wider, as cover the same when they are a third of the level's error wide. A plant without branches
/// gets levels for them. After the branches' levels (foliage/line_levels.h). Cost: linear.
void add_leaf_lines(std::span<const LineSegment> leaves, PreparedPlant& ready);

/// Of the lines of one list that are leaves'; means weighted by length.
struct LeafLineSize {
  double width_m = 0, length_m = 0;  ///< 0 without such lines
};
LeafLineSize leaf_line_size(const PreparedPlant& plant);

}  // namespace manzana::foliage
