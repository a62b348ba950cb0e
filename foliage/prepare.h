#pragma once
/// From a plant to what is drawn of it at every distance. The parts: branch_levels.h, leaf_cloud.h; visibility is baked
/// by foliage/gl, which has the means.
#include <functional>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

struct PrepareOptions {
  std::uint32_t quads_per_cell = 256;  ///< cells are split until they have no more
  std::uint32_t branch_levels = 4;     ///< meshes of branches
  std::uint64_t seed = 1;
  std::function<void(double)> progress{};  ///< called with [0, 1] now and then; may be empty
};

/// The same for the same plant and options on every machine. Throws std::invalid_argument where check(plant) does.
PreparedPlant prepare(const Plant& plant, const PrepareOptions& options = {});

}  // namespace manzana::foliage
