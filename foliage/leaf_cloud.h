#pragma once
/// Leaves as a cloud of cells with quads in random order, and as points.
///   prepare_leaves(plant, options, ready);   // fills leaves, cells, shuffled, points, point_levels, areas and scales
#include "foliage/prepare.h"

namespace manzana::foliage {

void prepare_leaves(const Plant& plant, const PrepareOptions& options, PreparedPlant& ready);

}  // namespace manzana::foliage
