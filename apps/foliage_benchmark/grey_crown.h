#pragma once
/// What of a crown can be seen, as grey.  [Gumbau 2009, figure 4]
#include "apps/foliage_benchmark/picture.h"
#include "foliage/prepared_plant.h"

namespace manzana::foliage_benchmark {

/// Each cell's leaves by the share of it that a camera sees: white all, black nothing. From that camera, and from its
/// left, so that the camera is to the right. Drawn by parallel rays on the CPU; bark is brown.
Picture grey_crown(const foliage::PreparedPlant& plant, int pixels);

}  // namespace manzana::foliage_benchmark
