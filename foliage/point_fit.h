#pragma once
/// How large points must be for a crown to cover what its leaves do, with branches as our law has them at that
/// distance.
#include "foliage/prepared_plant.h"
#include "foliage/progress.h"

namespace manzana::foliage {

/// Multiplies the areas of each level's points, then sets what they are multiplied by between levels and between leaf
/// quads and points: PointLevel::area and between, PreparedPlant::turning. Half the leaves' area is right only for
/// points far apart: at the finest level points of one leaf hide each other, and merged ones no longer hide each other
/// as the leaves did. Factors of levels are in [1/8, 8], the others in [1/2, 2]; those of turning are 1 where leaves
/// are thin, since they are lines by then. After leaf_scale and cover_m2 are known.
void fit_points(PreparedPlant& plant, const Progress& progress = {});

}  // namespace manzana::foliage
