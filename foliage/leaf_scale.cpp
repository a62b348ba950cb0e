#include "foliage/leaf_scale.h"

#include <algorithm>
#include <cmath>

#include "foliage/random.h"
#include "foliage/root.h"
#include "foliage/silhouettes.h"

namespace manzana::foliage {
namespace {

// How steeply views look down, by turns.
constexpr std::array kLeafViews{0.05, 0.6};

}  // namespace

LeafScaleFit fit_leaf_scale(const PreparedPlant& plant, const Progress& progress) {
  LeafScaleFit out;
  out.scale.fill(1);
  if (plant.leaves.empty() && plant.bark.empty()) return out;
  const Silhouettes pictures(plant, kLeafViews);
  const Silhouettes::Coverage full = pictures.coverage(1, 1);
  out.cover_m2 = static_cast<float>(covered(full) / Silhouettes::kViews) * pictures.pixel_m2();
  if (plant.leaves.empty()) return out;
  for (std::size_t i = 1; i < kLeafScales; ++i) {
    const double u = std::exp2(-0.5 * static_cast<double>(i));
    out.scale[i] =
        root(out.scale[i - 1], 16, [&](float s) { return covered(pictures.coverage(u, s)) / covered(full) - 1; });
    const Silhouettes::Coverage now = pictures.coverage(u, out.scale[i]);
    for (std::size_t v = 0; v < Silhouettes::kViews; ++v)
      out.residual[i][v] = static_cast<float>(now[v]) / static_cast<float>(full[v]) - 1;
    tell(progress, i, kLeafScales - 1);
  }
  return out;
}

float covered_m2(const PreparedPlant& plant, double rise) {
  const Silhouettes pictures(plant, std::array{rise});
  return static_cast<float>(covered(pictures.coverage(1, 1)) / Silhouettes::kViews) * pictures.pixel_m2();
}

float leaf_scale_at(const std::array<float, kLeafScales>& scale, float u) {
  if (!(u < 1)) return scale.front();
  const float at = u > 0 ? std::min(-2 * std::log2(u), static_cast<float>(kLeafScales - 1)) : kLeafScales - 1;
  const auto row = std::min(static_cast<std::size_t>(at), kLeafScales - 2);
  return glm::mix(scale[row], scale[row + 1], at - static_cast<float>(row));
}

double cell_threshold(std::uint32_t cell) { return static_cast<double>(Random(hash(cell)).uniform()); }

}  // namespace manzana::foliage
