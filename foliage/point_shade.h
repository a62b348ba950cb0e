#pragma once
/// Points that stand for many leaves take the mean of their light, but what is seen of a crown are its outer leaves, in
/// more light than those behind. So the light of each level's points is fitted to what is seen of the leaves.
#include "foliage/prepared_plant.h"
#include "foliage/progress.h"

namespace manzana::foliage {

/// How bright a leaf of this shade is, about as a host lights it: sun and sky.
inline float arriving(float shade) { return 0.25F + 0.3F * shade + 0.45F * shade * shade; }
float shade_of(float arriving);  ///< the other way; 0 or more

/// Changes the shades of each level's points, so that what is seen of them from six sides is as bright on film as the
/// leaves are: film shows dark things darker. After the areas are fitted (leaf_scale.h).
void fit_point_shades(PreparedPlant& plant, const Progress& progress = {});

}  // namespace manzana::foliage
