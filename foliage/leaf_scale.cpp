#include "foliage/leaf_scale.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "foliage/lod_factor.h"
#include "foliage/random.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kViews = LeafScaleFit::kViews;
constexpr int kPixels = 256;

/// From half around, since a silhouette is the same from behind; by turns level and from above.
Vec3d view_direction(std::size_t view) {
  const double angle = 3.14159265358979 * static_cast<double>(view) / kViews + 0.1;
  return glm::normalize(Vec3d(std::cos(angle), std::sin(angle), view % 2 == 0 ? 0.05 : 0.6));
}

struct Ball {
  Vec3 centre;
  float radius;
};

/// With room for leaves that grow out of the crown.
Ball ball_of(const PreparedPlant& plant) {
  Vec3 low(3e38F), high(-3e38F);
  for (const auto* part : {&plant.bark, &plant.leaves})
    for (const PlantQuad& quad : *part)
      for (const PlantQuad::Corner& c : quad.corners)
        low = glm::min(low, c.position), high = glm::max(high, c.position);
  return {0.5F * (low + high), 0.55F * glm::length(high - low)};
}

using Hits = std::vector<std::uint8_t>;

/// The plant's silhouettes from all views.
class Silhouettes {
 public:
  explicit Silhouettes(const PreparedPlant& plant) : plant_(plant), holes_(plant.leaf_image) {
    const Ball ball = ball_of(plant);
    for (std::size_t v = 0; v < kViews; ++v) {
      views_.emplace_back(view_direction(v), ball.centre, ball.radius, kPixels);
      bark_.emplace_back(std::size_t{kPixels} * kPixels, std::uint8_t{0});
    }
    tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
      for (const PlantQuad& quad : plant.bark) draw(quad, 1, false, views_[v], bark_[v]);
    });
  }

  using Coverage = std::array<std::size_t, kViews>;  // pixels

  Coverage coverage(double u, float scale) const {
    Coverage count{};
    tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
      Hits hits = bark_[v];
      for (std::uint32_t c = 0; c < plant_.cells.size(); ++c) {
        const Run& quads = plant_.cells[c].quads;
        const auto last = quads.first + static_cast<std::uint32_t>(kept(quads.size(), u, cell_threshold(c)));
        for (std::uint32_t q = quads.first; q < last; ++q) draw(plant_.leaves[q], scale, true, views_[v], hits);
      }
      count[v] = static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
    });
    return count;
  }

 private:
  void draw(const PlantQuad& quad, float scale, bool leaf, const ParallelView& view, Hits& hits) const {
    std::array<Vec2, 4> at, uv;
    for (std::size_t k = 0; k < 4; ++k) {
      at[k] = view.pixel(scaled_corner(quad, k, scale));
      uv[k] = Vec2(quad.corners[k].u, quad.corners[k].v) * (kUvRange / 65535);
    }
    for (const std::size_t k : {1U, 2U})
      for_each_pixel({at[0], at[k], at[k + 1]}, kPixels, [&](int x, int y, float v, float w) {
        std::uint8_t& hit = hits[static_cast<std::size_t>(y * kPixels + x)];
        if (hit == 0 && (!leaf || holes_.opaque(uv[0] + (uv[k] - uv[0]) * v + (uv[k + 1] - uv[0]) * w))) hit = 1;
      });
  }

  const PreparedPlant& plant_;
  LeafHoles holes_;
  std::vector<ParallelView> views_;
  std::vector<Hits> bark_;
};

double sum(const Silhouettes::Coverage& coverage) {
  double all = 0;
  for (const std::size_t pixels : coverage) all += static_cast<double>(pixels);
  return all;
}

/// The scale at which the coverage is the wanted one, from `least` on: coverage grows with it.
float fit(const Silhouettes& pictures, double u, double wanted, float least) {
  constexpr float kMost = 16;
  constexpr double kNear = 0.0005;  // of the coverage: a third of what 500 000 pixels scatter
  double low = std::log2(static_cast<double>(least)), high = low;
  double below = sum(pictures.coverage(u, least)) / wanted - 1, above = below;
  while (above < 0 && high < std::log2(static_cast<double>(kMost))) {
    low = high, below = above;
    high += 0.25;
    above = sum(pictures.coverage(u, static_cast<float>(std::exp2(high)))) / wanted - 1;
  }
  if (below >= 0) return least;
  if (above <= 0) return kMost;
  for (int round = 0; round < 6; ++round) {  // the false position, kept off the ends
    const double t = std::clamp(-below / (above - below), 0.1, 0.9), middle = low + (high - low) * t;
    const double at = sum(pictures.coverage(u, static_cast<float>(std::exp2(middle)))) / wanted - 1;
    (at < 0 ? low : high) = middle;
    (at < 0 ? below : above) = at;
    if (std::abs(at) < kNear) return static_cast<float>(std::exp2(middle));
  }
  return static_cast<float>(std::exp2(low + (high - low) * -below / (above - below)));
}

}  // namespace

LeafScaleFit fit_leaf_scale(const PreparedPlant& plant) {
  LeafScaleFit out;
  out.scale.fill(1);
  if (plant.leaves.empty()) return out;
  const Silhouettes pictures(plant);
  const Silhouettes::Coverage full = pictures.coverage(1, 1);
  for (std::size_t i = 1; i < kLeafScales; ++i) {
    const double u = std::exp2(-0.5 * static_cast<double>(i));
    out.scale[i] = fit(pictures, u, sum(full), out.scale[i - 1]);
    const Silhouettes::Coverage now = pictures.coverage(u, out.scale[i]);
    for (std::size_t v = 0; v < kViews; ++v)
      out.residual[i][v] = static_cast<float>(now[v]) / static_cast<float>(full[v]) - 1;
  }
  return out;
}

float leaf_scale_at(const std::array<float, kLeafScales>& scale, float u) {
  if (!(u < 1)) return scale.front();
  const float at = u > 0 ? std::min(-2 * std::log2(u), static_cast<float>(kLeafScales - 1)) : kLeafScales - 1;
  const auto row = std::min(static_cast<std::size_t>(at), kLeafScales - 2);
  return glm::mix(scale[row], scale[row + 1], at - static_cast<float>(row));
}

double cell_threshold(std::uint32_t cell) { return static_cast<double>(Random(hash(cell)).uniform()); }

}  // namespace manzana::foliage
