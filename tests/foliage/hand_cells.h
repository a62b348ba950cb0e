#pragma once
/// Cells of leaves made by hand.
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// A square across x, with its middle at (x, y, z), as wide as twice `half`.
inline PlantQuad square(float x, float half, float y = 0, float z = 0) {
  PlantQuad quad{};
  const float dy[]{-half, half, half, -half}, dz[]{-half, -half, half, half};
  for (std::size_t k = 0; k < 4; ++k) quad.corners[k].position = {x, y + dy[k], z + dz[k]};
  return quad;
}

inline void add_cell(PreparedPlant& plant, const std::vector<PlantQuad>& quads) {
  const auto first = static_cast<std::uint32_t>(plant.leaves.size());
  plant.leaves.insert(plant.leaves.end(), quads.begin(), quads.end());
  plant.cells.push_back({{}, Mat3(1), Vec3(1), {first, static_cast<std::uint32_t>(plant.leaves.size())}});
}

}  // namespace manzana::foliage
