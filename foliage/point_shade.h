#pragma once
/// Points that stand for many leaves take the mean of their light, but what is seen of a crown are its outer leaves, in
/// more light than those behind. So the light of each level's points is fitted to what is seen of the leaves.
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Multiplies the shades of each level's points, so that the squares of what is seen of them from six sides have the
/// mean that those of the leaves have: sunlight goes by the square. After the areas are fitted (leaf_scale.h).
void fit_point_shades(PreparedPlant& plant);

}  // namespace manzana::foliage
