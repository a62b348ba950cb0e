#include "foliage/ldm_sampler.h"

#include <tbb/parallel_for.h>

#include <cassert>
#include <span>

#include "foliage/ldm_texture.h"
#include "foliage/leaf_image.h"
#include "foliage/leaf_texture.h"
#include "foliage/plant_mesh.h"
#include "foliage/random.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

/// A quad as one side sees it.
struct SeenQuad {
  const PlantQuad* quad;
  std::uint32_t row;  ///< of all quads, bark first
  bool leaf;
  std::array<Vec2, 4> pixels;
  std::array<float, 4> nearness;
};

/// The nearest of a pixel's.
struct Hit {
  float depth = 2;  ///< of the slab, 0 to 1
  const SeenQuad* seen = nullptr;
  QuadPart part{1, 2};
  float v = 0, w = 0;  ///< weights of the part's corners 1 and 2
  std::uint8_t level = 0;
};

template <class T>
T mean_at(const std::array<T, 4>& corners, const Hit& hit) {
  return corners[0] + (corners[hit.part.b] - corners[0]) * hit.v + (corners[hit.part.c] - corners[0]) * hit.w;
}

/// Of four channels one, between the four texels next to the place; uv repeat.
float filtered(const Image& image, const Vec2& uv, std::size_t channel) {
  const Vec2 at = uv * static_cast<float>(image.size) - 0.5F, low = glm::floor(at), part = at - low;
  const auto texel = [&](int dx, int dy) {
    const int mask = image.size - 1, x = (static_cast<int>(low.x) + dx) & mask,
              y = (static_cast<int>(low.y) + dy) & mask;
    return static_cast<float>(image.rgba[4 * static_cast<std::size_t>(y * image.size + x) + channel]);
  };
  return std::lerp(std::lerp(texel(0, 0), texel(1, 0), part.x), std::lerp(texel(0, 1), texel(1, 1), part.x), part.y);
}

// As foliage/shaders/cover.glsl has them, with one sample a pixel.
float pixel_noise(float noise, int x, int y) {
  const float along = (static_cast<float>(x) + 0.5F) * 0.06711056F + (static_cast<float>(y) + 0.5F) * 0.00583715F,
              sum = 52.9829189F * (along - std::floor(along)) + noise;
  return sum - std::floor(sum);
}

/// What is seen of a picture from so far that a pixel has so many of its texels, a side.
struct Sharpness {
  explicit Sharpness(float texels) {
    const float levels = std::log2(std::max(texels, 1e-6F));
    level = levels <= 0.5F ? 0 : static_cast<std::uint8_t>(std::min(std::ceil(levels + 0.5F) - 1, 8.0F));
    blurred = std::clamp(levels - 3.5F, 0.0F, 1.0F);
  }
  std::uint8_t level;
  float blurred;
};

class Slab {
 public:
  Slab(int pixels, float front, float thickness)
      : pixels_(pixels), front_(front), thickness_(thickness), hits_(static_cast<std::size_t>(pixels * pixels)) {}

  void draw(const SeenQuad& seen, std::span<const Image> leaf) {
    const QuadUv uv(*seen.quad);
    std::array<float, 4> depth;
    for (std::size_t c = 0; c < 4; ++c) depth[c] = (front_ - seen.nearness[c]) / thickness_;
    const float noise = static_cast<float>(hash(seen.row) >> 40) * 0x1p-24F;
    for_each_quad_span(seen.pixels, form_of(*seen.quad, uv), pixels_, [&](const PixelSpan& span, const QuadPart& part) {
      const Along along_depth(span, depth, part), u(span, uv.u, part), v(span, uv.v, part);
      const Sharpness sharp(texels_a_pixel(seen, uv, part));
      for (int i = 0; i < span.last - span.first; ++i) {
        const int x = span.first + i;
        Hit& hit = at(x, span.y);
        const float z = along_depth[i];
        if (z < 0 || z > 1 || z > hit.depth) continue;
        if (seen.leaf && !covers(leaf, {u[i], v[i]}, sharp, noise, x, span.y)) continue;
        const auto step = static_cast<float>(i);
        hit = {z, &seen, part, span.v + step * span.dv, span.w + step * span.dw, sharp.level};
      }
    });
  }
  const Hit& hit(int x, int y) const { return hits_[static_cast<std::size_t>(y * pixels_ + x)]; }

 private:
  Hit& at(int x, int y) { return hits_[static_cast<std::size_t>(y * pixels_ + x)]; }

  static bool covers(std::span<const Image> leaf, const Vec2& uv, const Sharpness& sharp, float noise, int x, int y) {
    const float alpha = filtered(leaf[sharp.level], uv, 3) / 255;
    return std::lerp(alpha >= 0.5F ? 1.0F : 0.0F, alpha, sharp.blurred) + pixel_noise(noise, x, y) >= 1;
  }

  /// The longer way of a picture, along x and y.
  static float texels_a_pixel(const SeenQuad& seen, const QuadUv& uv, const QuadPart& part) {
    const Vec2 b = seen.pixels[part.b] - seen.pixels[0], c = seen.pixels[part.c] - seen.pixels[0],
               tb(uv.u[part.b] - uv.u[0], uv.v[part.b] - uv.v[0]), tc(uv.u[part.c] - uv.u[0], uv.v[part.c] - uv.v[0]);
    const float area = b.x * c.y - b.y * c.x;
    const Vec2 dx = (tb * c.y - tc * b.y) / area, dy = (tc * b.x - tb * c.x) / area;
    return kPlantImageSize * std::max(glm::length(dx), glm::length(dy));
  }

  int pixels_;
  float front_, thickness_;
  std::vector<Hit> hits_;
};

LdmTexel texel_of(const Hit& hit, std::span<const Image> pictures) {
  const PlantQuad& quad = *hit.seen->quad;
  const QuadUv corners(quad);
  std::array<Vec3, 4> normals;
  std::array<float, 4> shades;
  for (std::size_t c = 0; c < 4; ++c)
    normals[c] = unpack_normal(quad.normals[c]), shades[c] = static_cast<float>(quad.shades[c]) / 255;
  const Vec2 uv(mean_at(corners.u, hit), mean_at(corners.v, hit));
  const Vec3 normal = mean_at(normals, hit);
  const auto n = glm::dot(normal, normal) > 0 ? pack_ldm_normal(normal) : std::array<std::uint8_t, 2>{128, 128};
  LdmTexel texel;
  for (std::size_t c = 0; c < 3; ++c)
    texel.colour[c] = static_cast<std::uint8_t>(std::lround(filtered(pictures[hit.level], uv, c)));
  texel.colour[3] = 255;
  texel.normal_x = n[0], texel.normal_y = n[1];
  texel.depth = static_cast<std::uint8_t>(std::lround(255 * hit.depth));
  texel.shade = static_cast<std::uint8_t>(std::floor(std::clamp(mean_at(shades, hit), 0.0F, 1.0F) * 127 + 0.5F) +
                                          (hit.seen->leaf ? 128 : 0));
  return texel;
}

std::vector<SeenQuad> seen_quads(const PreparedPlant& plant, const ParallelView& view, int fine) {
  std::vector<SeenQuad> all;
  const auto add = [&](const PlantQuad& quad, std::size_t row, bool leaf) {
    SeenQuad seen{&quad, static_cast<std::uint32_t>(row), leaf, {}, {}};
    for (std::size_t c = 0; c < 4; ++c) {
      seen.pixels[c] = view.pixel(quad.corners[c].position) * static_cast<float>(fine);
      seen.nearness[c] = view.nearness(quad.corners[c].position);
    }
    all.push_back(seen);
  };
  const Run bark = finest_bark(plant);
  for (std::uint32_t i = bark.first; i < bark.last; ++i) add(plant.bark[i], i, false);
  for (std::size_t i = 0; i < plant.leaves.size(); ++i) add(plant.leaves[i], plant.bark.size() + i, true);
  return all;
}

/// Slab after slab the quads that reach into it: most are in one or two.
std::vector<std::vector<const SeenQuad*>> by_slab(std::span<const SeenQuad> quads, float radius, int layers) {
  std::vector<std::vector<const SeenQuad*>> slabs(static_cast<std::size_t>(layers));
  const auto slab = [&](float nearness) {
    return std::clamp(static_cast<int>((radius - nearness) * static_cast<float>(layers) / (2 * radius)), 0, layers - 1);
  };
  for (const SeenQuad& quad : quads) {
    const auto [farthest, nearest] = std::minmax_element(quad.nearness.begin(), quad.nearness.end());
    for (int i = slab(*nearest); i <= slab(*farthest); ++i) slabs[static_cast<std::size_t>(i)].push_back(&quad);
  }
  return slabs;
}

}  // namespace

LdmSampler::LdmSampler(const PreparedPlant& plant, int fine)
    : plant_(&plant),
      fine_(fine),
      bark_(coverage_mipmaps(resized(plant.bark_image, kPlantImageSize))),
      leaf_(coverage_mipmaps(resized(plant.leaf_image, kPlantImageSize))) {
  assert(fine == 1 || fine == 2 || fine == 4 || fine == 8);
}

LdmImage LdmSampler::operator()(const ParallelView& view, int layers) const {
  LdmImage image(layers);
  const std::vector<SeenQuad> quads = seen_quads(*plant_, view, fine_);
  const auto slabs = by_slab(quads, view.radius(), layers);
  const float thickness = 2 * view.radius() / static_cast<float>(layers);
  tbb::parallel_for(0, layers, [&](int layer) {
    Slab slab(fine_ * kLdmPixels, view.radius() - static_cast<float>(layer) * thickness, thickness);
    for (const SeenQuad* quad : slabs[static_cast<std::size_t>(layer)]) slab.draw(*quad, leaf_);
    for (int y = 0; y < kLdmPixels; ++y)
      for (int x = 0; x < kLdmPixels; ++x) {
        LdmSum sum;
        for (int k = 0; k < fine_ * fine_; ++k) {
          const Hit& hit = slab.hit(x * fine_ + k % fine_, y * fine_ + k / fine_);
          if (hit.seen != nullptr) sum.add(texel_of(hit, hit.seen->leaf ? leaf_ : bark_), 1);
        }
        if (sum.weight() == 0) continue;
        const float alpha = 255 * sum.weight() / static_cast<float>(fine_ * fine_);
        image.at(layer, x, y) = sum.mean(static_cast<std::uint8_t>(std::lround(alpha)));
      }
  });
  return image;
}

}  // namespace manzana::foliage
