#include "foliage/point_shade.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kViews = 6;
constexpr int kPixels = 256;

Vec3d view_direction(std::size_t view) {
  const double angle = 6.28318530717959 * static_cast<double>(view) / kViews + 0.2;
  return glm::normalize(Vec3d(std::cos(angle), std::sin(angle), view % 2 == 0 ? 0.05 : 0.5));
}

/// What is nearest in each pixel, and its shade.
class ShadePicture {
 public:
  explicit ShadePicture(const ParallelView& view)
      : view_(view),
        near_(std::size_t{kPixels} * kPixels, -std::numeric_limits<float>::infinity()),
        shade_(near_.size()) {}

  void draw(const PlantQuad& quad, const LeafHoles& holes) {
    std::array<Vec2, 4> at;
    std::array<float, 4> near, shade;
    for (std::size_t k = 0; k < 4; ++k) {
      at[k] = view_.pixel(quad.corners[k].position);
      near[k] = view_.nearness(quad.corners[k].position);
      shade[k] = static_cast<float>(quad.shades[k]) / 255;
    }
    const QuadUv uv(quad);
    for_each_quad_span(at, Form::triangle, kPixels, [&](const PixelSpan& span, const QuadPart& part) {
      const Along u(span, uv.u, part), v(span, uv.v, part), depth(span, near, part), light(span, shade, part);
      for (int i = 0; i < span.last - span.first; ++i)
        if (holes.opaque(u[i], v[i])) put(span.first + i, span.y, {depth[i], light[i]});
    });
  }

  void draw(const LeafPoint& point) {
    const Vec2 middle = view_.pixel(point.position);
    const float half = view_.pixels_of(std::sqrt(point.area)) / 2;
    const auto pixel = [](float v) { return static_cast<int>(std::clamp(std::ceil(v - 0.5F), 0.0F, float{kPixels})); };
    for (int y = pixel(middle.y - half); y < pixel(middle.y + half); ++y)
      for (int x = pixel(middle.x - half); x < pixel(middle.x + half); ++x)
        put(x, y, {view_.nearness(point.position), point.shade});
  }

  /// Mean of the squares over what is covered.
  double brightness() const {
    double sum = 0, pixels = 0;
    for (std::size_t i = 0; i < near_.size(); ++i)
      if (std::isfinite(near_[i])) sum += static_cast<double>(shade_[i] * shade_[i]), pixels += 1;
    return pixels > 0 ? sum / pixels : 0;
  }

 private:
  void put(int x, int y, const Vec2& depth_shade) {
    const auto i = static_cast<std::size_t>(y * kPixels + x);
    if (depth_shade.x <= near_[i]) return;
    near_[i] = depth_shade.x;
    shade_[i] = depth_shade.y;
  }

  const ParallelView& view_;
  std::vector<float> near_, shade_;
};

/// Mean over the views of what `draw` puts into each one's picture.
template <class Draw>  // void(ShadePicture&)
double mean_brightness(const PreparedPlant& plant, Draw&& draw) {
  std::array<double, kViews> brightness{};
  tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
    const ParallelView view = view_of(plant, view_direction(v), kPixels, 1.1F);
    ShadePicture picture(view);
    draw(picture);
    brightness[v] = picture.brightness();
  });
  double sum = 0;
  for (const double b : brightness) sum += b / kViews;
  return sum;
}

}  // namespace

void fit_point_shades(PreparedPlant& plant) {
  const LeafHoles holes(plant.leaf_image);
  const double leaves = mean_brightness(plant, [&](ShadePicture& picture) {
    for (const PlantQuad& quad : plant.leaves) picture.draw(quad, holes);
  });
  for (const PointLevel& level : plant.point_levels) {
    const double points = mean_brightness(plant, [&](ShadePicture& picture) {
      for (std::uint32_t p = level.points.first; p < level.points.last; ++p) picture.draw(plant.points[p]);
    });
    if (!(leaves > 0 && points > 0)) continue;
    const auto factor = static_cast<float>(std::sqrt(leaves / points));
    for (std::uint32_t p = level.points.first; p < level.points.last; ++p)
      plant.points[p].shade = std::min(1.0F, plant.points[p].shade * factor);
  }
}

}  // namespace manzana::foliage
