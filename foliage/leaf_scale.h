#pragma once
/// How much leaves must grow when few of them are kept, so that the crown covers what it covered. The sources' 1 / u on
/// each axis overshoots by hundreds of per cent, and its root, the area's rule, by 10 to 70: leaves overlap, and they
/// are scaled about their petioles. So s(u) is fitted by drawing the crown, for each plant.
#include "foliage/prepared_plant.h"
#include "foliage/progress.h"

namespace manzana::foliage {

/// Share of u = 2^(-i/2) of the leaves.
inline constexpr std::size_t kLeafScales = 17;

struct LeafScaleFit {
  std::array<float, kLeafScales> scale{};  ///< linear, from 1 on, not falling
  static constexpr std::size_t kViews = 8;
  float cover_m2 = 0;                                             ///< of the whole plant, mean over the views
  std::array<std::array<float, kViews>, kLeafScales> residual{};  ///< of each view's coverage: 0.01 is 1 % too much
};

/// From the bark, leaves and cells of a plant, over eight views with bark and alpha test. Of each cell are kept()
/// (foliage/ lod_factor.h) its leaves, at a threshold of its own. Coverage is that of the mean view. Cost: about a
/// second for 100 000 triangles, on all cores.
LeafScaleFit fit_leaf_scale(const PreparedPlant& plant, const Progress& progress = {});

/// m2 that the plant hides, mean over eight sides; `rise`: how much higher the eye is than the plant, over how far
/// away.
float covered_m2(const PreparedPlant& plant, double rise);

/// At any u in (0, 1], between the fitted ones by the logarithm of u; 1 from u = 1 on, the last below the last.
float leaf_scale_at(const std::array<float, kLeafScales>& scale, float u);

/// A quad's corner when its leaf is scaled about the petiole.
inline Vec3 scaled_corner(const PlantQuad& quad, std::size_t k, float scale) {
  return quad.anchor + (quad.corners[k].position - quad.anchor) * scale;
}

/// The threshold in [0, 1) of a cell of a plant that stands alone.
double cell_threshold(std::uint32_t cell);

}  // namespace manzana::foliage
