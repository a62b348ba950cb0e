#include "foliage/point_shade.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <span>

#include "foliage/leaf_image.h"
#include "foliage/raster.h"
#include "foliage/texel_mean.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kViews = 6;
constexpr int kPixels = 256;
constexpr float kLightest = 1.5F;

Vec3d view_direction(std::size_t view) {
  const double angle = 6.28318530717959 * static_cast<double>(view) / kViews + 0.2;
  return glm::normalize(Vec3d(std::cos(angle), std::sin(angle), view % 2 == 0 ? 0.05 : 0.5));
}

/// Of a picture's texels; white without one. uv repeat.
class LeafLuminance {
 public:
  explicit LeafLuminance(const Image& image) : size_(std::max(image.size, 1)), texels_(smooth_luminance(image)) {}
  float at(const Vec2& uv) const {
    const auto place = [&](float v) {
      return static_cast<std::size_t>(
          std::clamp(static_cast<int>((v - std::floor(v)) * static_cast<float>(size_)), 0, size_ - 1));
    };
    return texels_[place(uv.y) * static_cast<std::size_t>(size_) + place(uv.x)];
  }

 private:
  int size_;
  std::vector<float> texels_;
};

/// Of what a pixel shows: its mean, and the standard deviation over that. Nothing: 0.
struct Light {
  float mean = 0, contrast = 0;
};

Light light_of(const LeafPoint& point) {
  const auto channel = [&](int shift) { return linear_of_srgb(static_cast<std::uint8_t>(point.colour >> shift)); };
  return {luminance({channel(0), channel(8), channel(16)}) * arriving(point.shade),
          static_cast<float>(point.colour >> 24) / 255};
}

/// What is nearest in each pixel.
class LightPicture {
 public:
  explicit LightPicture(const ParallelView& view)
      : lights(std::size_t{kPixels} * kPixels), view_(view), near_(lights.size(), -1e30F) {}

  void draw(const PlantQuad& quad, const LeafHoles& holes, const LeafLuminance& leaf) {
    std::array<Vec2, 4> at;
    std::array<float, 4> near, shade;
    for (std::size_t k = 0; k < 4; ++k) {
      at[k] = view_.pixel(quad.corners[k].position);
      near[k] = view_.nearness(quad.corners[k].position);
      shade[k] = static_cast<float>(quad.shades[k]) / 255;
    }
    const QuadUv uv(quad);
    for_each_quad_span(at, Form::triangle, kPixels, [&](const PixelSpan& span, const QuadPart& part) {
      const Along u(span, uv.u, part), v(span, uv.v, part), depth(span, near, part), shades(span, shade, part);
      for (int i = 0; i < span.last - span.first; ++i)
        if (holes.opaque(u[i], v[i]))
          put(span.first + i, span.y, depth[i], {arriving(shades[i]) * leaf.at({u[i], v[i]}), 0});
    });
  }

  void draw(const LeafPoint& point) {
    const Vec2 middle = view_.pixel(point.position);
    const float half = view_.pixels_of(std::sqrt(point.area)) / 2;
    const Light light = light_of(point);
    const auto pixel = [](float v) { return static_cast<int>(std::clamp(std::ceil(v - 0.5F), 0.0F, float{kPixels})); };
    for (int y = pixel(middle.y - half); y < pixel(middle.y + half); ++y)
      for (int x = pixel(middle.x - half); x < pixel(middle.x + half); ++x)
        put(x, y, view_.nearness(point.position), light);
  }

  std::vector<Light> lights;

 private:
  void put(int x, int y, float near, const Light& light) {
    const auto i = static_cast<std::size_t>(y * kPixels + x);
    if (near <= near_[i]) return;
    near_[i] = near;
    lights[i] = light;
  }

  const ParallelView& view_;
  std::vector<float> near_;
};

/// What `draw` puts into the pictures from all sides.
template <class Draw>  // void(LightPicture&)
std::vector<Light> seen(const PreparedPlant& plant, Draw&& draw) {
  std::array<std::vector<Light>, kViews> views;
  tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
    const ParallelView view = view_of(plant, view_direction(v), kPixels, 1.1F);
    LightPicture picture(view);
    draw(picture);
    std::erase_if(picture.lights, [](const Light& light) { return light.mean <= 0; });
    views[v] = std::move(picture.lights);
  });
  std::vector<Light> all;
  for (const std::vector<Light>& view : views) all.insert(all.end(), view.begin(), view.end());
  return all;
}

/// As film has it: by the square where it is dark, in proportion where it is bright.
float shown(float light) { return light * light / (light + 0.1F); }

/// Mean, `factor` times as bright.
double brightness(std::span<const Light> lights, float factor) {
  double sum = 0;
  for (const Light& light : lights)
    sum += static_cast<double>(shown(factor * light.mean * (1 + light.contrast)) +
                               shown(factor * light.mean * (1 - light.contrast)));
  return sum / (2 * static_cast<double>(lights.size()));
}

/// By how much `lights` must be brighter to be as bright as asked for; in [1/4, 4].
float factor_for(std::span<const Light> lights, double wanted) {
  float low = -2, high = 2;
  for (int round = 0; round < 14; ++round) {
    const float middle = (low + high) / 2;
    (brightness(lights, std::exp2(middle)) < wanted ? low : high) = middle;
  }
  return std::exp2((low + high) / 2);
}

}  // namespace

float shade_of(float arriving) {
  const float root = 0.09F - 4 * 0.45F * (0.25F - arriving);
  return root > 0.09F ? (std::sqrt(root) - 0.3F) / 0.9F : 0;
}

void fit_point_shades(PreparedPlant& plant, const Progress& progress) {
  const LeafHoles holes(plant.leaf_image);
  const LeafLuminance luminances(plant.leaf_image);
  const std::vector<Light> leaves = seen(plant, [&](LightPicture& picture) {
    for (const PlantQuad& quad : plant.leaves) picture.draw(quad, holes, luminances);
  });
  if (leaves.empty()) return;
  const double wanted = brightness(leaves, 1);
  for (std::size_t i = 0; i < plant.point_levels.size(); ++i) {
    tell(progress, i, plant.point_levels.size());
    const PointLevel& level = plant.point_levels[i];
    const std::span points = std::span(plant.points).subspan(level.points.first, level.points.size());
    const std::vector<Light> lights = seen(plant, [&](LightPicture& picture) {
      for (const LeafPoint& point : points) picture.draw(point);
    });
    if (lights.empty()) continue;
    const float factor = factor_for(lights, wanted);
    for (LeafPoint& point : points) point.shade = std::min(kLightest, shade_of(arriving(point.shade) * factor));
  }
}

}  // namespace manzana::foliage
