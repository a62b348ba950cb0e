#include "foliage/leaf_scale.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "foliage/lod_factor.h"
#include "foliage/random.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kViews = LeafScaleFit::kViews;
constexpr int kPixels = 256;
constexpr float kMargin = 1.1F;  // leaves grow out of the crown

// How steeply views look down, by turns. Points are seen from far away, so from higher as well.
constexpr std::array kLeafViews{0.05, 0.6};
constexpr std::array kPointViews{0.03, 0.36, 1.0};

/// From half around, since a silhouette is the same from behind.
Vec3d view_direction(std::size_t view, std::span<const double> rises) {
  const double angle = 3.14159265358979 * static_cast<double>(view) / kViews + 0.1;
  return glm::normalize(Vec3d(std::cos(angle), std::sin(angle), rises[view % rises.size()]));
}

/// With room for a block past the last pixel.
using Hits = std::vector<std::uint8_t>;
constexpr int kBlock = 8;
bool all_hit(const std::uint8_t* first) {
  std::uint64_t eight;
  std::memcpy(&eight, first, kBlock);
  return eight == 0x0101010101010101U;
}

/// Points drawn as squares of so many times their areas.
struct Squares {
  Run points;
  float factor = 1;
};

/// The plant's silhouettes from all views.
class Silhouettes {
 public:
  Silhouettes(const PreparedPlant& plant, std::span<const double> rises) : plant_(plant), holes_(plant.leaf_image) {
    for (std::size_t v = 0; v < kViews; ++v) {
      views_.push_back(view_of(plant, view_direction(v, rises), kPixels, kMargin));
      bark_.emplace_back(std::size_t{kPixels} * kPixels + kBlock, std::uint8_t{0});
    }
    tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
      const Run bark = finest_bark(plant);
      for (std::uint32_t q = bark.first; q < bark.last; ++q) draw(plant.bark[q], 1, false, views_[v], bark_[v]);
    });
  }

  float pixel_m2() const { return 1 / (views_[0].pixels_of(1) * views_[0].pixels_of(1)); }

  using Coverage = std::array<std::size_t, kViews>;  // pixels

  Coverage coverage(double u, float scale) const {
    return counted([&](std::size_t v, Hits& hits) {
      for (std::uint32_t c = 0; c < plant_.cells.size(); ++c) {
        const Run& quads = plant_.cells[c].quads;
        const auto last = quads.first + static_cast<std::uint32_t>(kept(quads.size(), u, cell_threshold(c)));
        for (std::uint32_t q = quads.first; q < last; ++q) draw(plant_.leaves[q], scale, true, views_[v], hits);
      }
    });
  }

  Coverage point_coverage(std::span<const Squares> all) const {
    return counted([&](std::size_t v, Hits& hits) {
      for (const Squares& squares : all)
        for (std::uint32_t p = squares.points.first; p < squares.points.last; ++p)
          draw(plant_.points[p], squares.factor, views_[v], hits);
    });
  }

 private:
  template <class Draw>  // void(std::size_t view, Hits&)
  Coverage counted(Draw&& draw_all) const {
    Coverage count{};
    tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
      Hits hits = bark_[v];
      draw_all(v, hits);
      count[v] = static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
    });
    return count;
  }

  static void draw(const LeafPoint& point, float factor, const ParallelView& view, Hits& hits) {
    const Vec2 middle = view.pixel(point.position), half(0.5F * view.pixels_of(std::sqrt(point.area * factor)));
    const auto pixel = [](float v) { return first_pixel(v, kPixels); };
    const Vec2 low = middle - half, high = middle + half;
    for (int y = pixel(low.y); y < pixel(high.y); ++y)
      std::fill(hits.begin() + y * kPixels + pixel(low.x), hits.begin() + y * kPixels + pixel(high.x), std::uint8_t{1});
  }

  void draw(const PlantQuad& quad, float scale, bool leaf, const ParallelView& view, Hits& hits) const {
    std::array<Vec2, 4> at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = view.pixel(scaled_corner(quad, k, scale));
    const QuadUv uv(quad);
    for_each_quad_span(at, form_of(quad, uv), kPixels, [&](const PixelSpan& span, const QuadPart& part) {
      const Along u(span, uv.u, part), v(span, uv.v, part);
      std::uint8_t* hit = &hits[static_cast<std::size_t>(span.y * kPixels + span.first)];
      const int size = span.last - span.first;
      for (int i = 0; i < size; i += kLanes) {
        if (i % kBlock == 0 && all_hit(hit + i)) {  // most are, where leaves lie deep
          i += kBlock - kLanes;
          continue;
        }
        const Lanes<std::int32_t> texels = holes_.texels(u.lanes(i), v.lanes(i));
        for (int j = 0; j < std::min(size - i, kLanes); ++j)
          if (hit[i + j] == 0 && (!leaf || holes_.opaque(texels[j]))) hit[i + j] = 1;
      }
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

/// Where a growing function is 0, between `least` and `most`; an end where it is not. By false position over the
/// logarithm, kept off the ends.
template <class Function>  // double(float)
float root(float least, float most, Function&& function) {
  constexpr double kNear = 0.0005;  // of the coverage: a third of what 500 000 pixels scatter
  const auto at = [&](double exponent) { return function(static_cast<float>(std::exp2(exponent))); };
  const double end = std::log2(static_cast<double>(most));
  double low = std::log2(static_cast<double>(least)), high = low, below = at(low), above = below;
  if (below >= 0) return least;
  while (above < 0 && high < end) {
    low = high, below = above;
    high = std::min(high + 0.25, end);
    above = at(high);
  }
  if (above <= 0) return most;
  for (int round = 0; round < 6; ++round) {
    const double middle = low + (high - low) * std::clamp(-below / (above - below), 0.1, 0.9), value = at(middle);
    (value < 0 ? low : high) = middle;
    (value < 0 ? below : above) = value;
    if (std::abs(value) < kNear) return static_cast<float>(std::exp2(middle));
  }
  return static_cast<float>(std::exp2(low + (high - low) * -below / (above - below)));
}

/// So far from a level to the next, as foliage/shaders/select.glsl mixes them.
std::array<Squares, 2> mixture(const PreparedPlant& plant, std::size_t level, float x, float factor) {
  const Run &fine = plant.point_levels[level].points, &coarse = plant.point_levels[level + 1].points;
  const auto n = static_cast<float>(fine.size()), m = static_cast<float>(coarse.size()), shown = n + x * (m - n);
  const auto part = [](const Run& run, float count) {
    return Run{run.first, run.first + static_cast<std::uint32_t>(std::lround(count))};
  };
  return {{{part(fine, (1 - x) * n), factor * n / shown}, {part(coarse, x * m), factor * m / shown}}};
}

}  // namespace

LeafScaleFit fit_leaf_scale(const PreparedPlant& plant, const Progress& progress) {
  LeafScaleFit out;
  out.scale.fill(1);
  if (plant.leaves.empty() && plant.bark.empty()) return out;
  const Silhouettes pictures(plant, kLeafViews);
  const Silhouettes::Coverage full = pictures.coverage(1, 1);
  out.cover_m2 = static_cast<float>(sum(full) / kViews) * pictures.pixel_m2();
  if (plant.leaves.empty()) return out;
  for (std::size_t i = 1; i < kLeafScales; ++i) {
    const double u = std::exp2(-0.5 * static_cast<double>(i));
    out.scale[i] = root(out.scale[i - 1], 16, [&](float s) { return sum(pictures.coverage(u, s)) / sum(full) - 1; });
    const Silhouettes::Coverage now = pictures.coverage(u, out.scale[i]);
    for (std::size_t v = 0; v < kViews; ++v)
      out.residual[i][v] = static_cast<float>(now[v]) / static_cast<float>(full[v]) - 1;
    tell(progress, i, kLeafScales - 1);
  }
  return out;
}

float covered_m2(const PreparedPlant& plant, double rise) {
  const Silhouettes pictures(plant, std::array{rise});
  return static_cast<float>(sum(pictures.coverage(1, 1)) / kViews) * pictures.pixel_m2();
}

std::vector<float> fit_point_areas(const PreparedPlant& plant, const Progress& progress) {
  if (plant.leaves.empty()) return {};
  const Silhouettes pictures(plant, kPointViews);
  const double full = sum(pictures.coverage(1, 1));
  std::vector<float> factors;
  for (const PointLevel& level : plant.point_levels) {
    factors.push_back(root(0.125F, 8, [&](float f) {
      return sum(pictures.point_coverage(std::array{Squares{level.points, f}})) / full - 1;
    }));
    tell(progress, factors.size(), plant.point_levels.size());
  }
  return factors;
}

std::vector<std::array<float, 3>> fit_point_mixtures(const PreparedPlant& plant) {
  if (plant.leaves.empty()) return {};
  const Silhouettes pictures(plant, kPointViews);
  const double full = sum(pictures.coverage(1, 1));
  std::vector<std::array<float, 3>> factors;
  for (std::size_t i = 0; i + 1 < plant.point_levels.size(); ++i) {
    std::array<float, 3>& between = factors.emplace_back();
    for (std::size_t quarter = 0; quarter < between.size(); ++quarter)
      between[quarter] = root(0.5F, 2, [&](float f) {
        return sum(pictures.point_coverage(mixture(plant, i, 0.25F * static_cast<float>(quarter + 1), f))) / full - 1;
      });
  }
  return factors;
}

float leaf_scale_at(const std::array<float, kLeafScales>& scale, float u) {
  if (!(u < 1)) return scale.front();
  const float at = u > 0 ? std::min(-2 * std::log2(u), static_cast<float>(kLeafScales - 1)) : kLeafScales - 1;
  const auto row = std::min(static_cast<std::size_t>(at), kLeafScales - 2);
  return glm::mix(scale[row], scale[row + 1], at - static_cast<float>(row));
}

double cell_threshold(std::uint32_t cell) { return static_cast<double>(Random(hash(cell)).uniform()); }

}  // namespace manzana::foliage
