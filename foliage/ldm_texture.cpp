#include "foliage/ldm_texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "foliage/leaf_image.h"

namespace manzana::foliage {
namespace {

constexpr std::uint8_t kLeafBit = 128;

std::uint8_t to_byte(float v) { return static_cast<std::uint8_t>(std::clamp(v + 0.5F, 0.0F, 255.0F)); }

/// Top down: what is empty takes after its parent.
void fill_empty(std::vector<LdmSquare>& pyramid) {
  for (std::size_t level = pyramid.size() - 1; level-- > 0;) {
    LdmSquare& square = pyramid[level];
    const LdmSquare& parents = pyramid[level + 1];
    for (int y = 0; y < square.side; ++y)
      for (int x = 0; x < square.side; ++x) {
        LdmTexel& texel = square.at(x, y);
        if (texel.colour[3] > 0) continue;
        texel = parents.at(x / 2, y / 2);
        texel.colour[3] = 0;
      }
  }
}

double difference(const LdmTexel& a, const LdmTexel& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a.colour[c] * a.colour[3] - b.colour[c] * b.colour[3]);
  return sum / (3 * 255);
}

}  // namespace

std::array<std::uint8_t, 2> pack_ldm_normal(const Vec3& normal) {
  const Vec3 n = normal / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
  Vec2 p(n.x, n.y);
  if (n.z < 0) p = Vec2((1 - std::abs(n.y)) * (n.x < 0 ? -1.0F : 1.0F), (1 - std::abs(n.x)) * (n.y < 0 ? -1.0F : 1.0F));
  return {to_byte(127.5F + 127.5F * p.x), to_byte(127.5F + 127.5F * p.y)};
}

Vec3 unpack_ldm_normal(std::uint8_t x, std::uint8_t y) {
  const Vec2 p = Vec2(x, y) / 127.5F - 1.0F;
  Vec3 n(p.x, p.y, 1 - std::abs(p.x) - std::abs(p.y));
  if (n.z < 0)
    n = Vec3((1 - std::abs(p.y)) * (p.x < 0 ? -1.0F : 1.0F), (1 - std::abs(p.x)) * (p.y < 0 ? -1.0F : 1.0F), n.z);
  return glm::normalize(n);
}

void LdmSum::add(const LdmTexel& t, float w) {
  weight_ += w;
  colour_ += w * Vec3(linear_of_srgb(t.colour[0]), linear_of_srgb(t.colour[1]), linear_of_srgb(t.colour[2]));
  normal_ += w * unpack_ldm_normal(t.normal_x, t.normal_y);
  depth_ += w * static_cast<float>(t.depth);
  const float shade = w * static_cast<float>(t.shade & 127);
  if ((t.shade & kLeafBit) != 0)
    leaf_ += w, leaf_shade_ += shade;
  else
    bark_shade_ += shade;
}

LdmTexel LdmSum::mean(std::uint8_t alpha) const {
  LdmTexel t;
  for (int c = 0; c < 3; ++c) t.colour[static_cast<std::size_t>(c)] = srgb_of_linear(colour_[c] / weight_);
  t.colour[3] = alpha;
  if (glm::dot(normal_, normal_) > 0) {
    const auto packed = pack_ldm_normal(normal_);
    t.normal_x = packed[0], t.normal_y = packed[1];
  }
  t.depth = to_byte(depth_ / weight_);
  const bool is_leaf = 2 * leaf_ >= weight_;
  const float shade = is_leaf ? leaf_shade_ / leaf_ : bark_shade_ / (weight_ - leaf_);
  t.shade = static_cast<std::uint8_t>(std::min(shade + 0.5F, 127.0F)) | (is_leaf ? kLeafBit : std::uint8_t{0});
  return t;
}

LdmTexel ldm_mean(const std::array<const LdmTexel*, 4>& parts) {
  LdmSum sum;
  for (const LdmTexel* part : parts) sum.add(*part, static_cast<float>(part->colour[3]));
  const auto alpha = static_cast<std::uint8_t>((sum.weight() + 2) / 4);
  if (sum.weight() == 0)
    for (const LdmTexel* part : parts) sum.add(*part, 1);
  return sum.mean(alpha);
}

LdmImage coarser(const LdmImage& image, int pixel, int merged) {
  assert(image.pixels % pixel == 0 && image.layers % merged == 0);
  LdmImage out(image.layers / merged, image.pixels / pixel);
  for (int layer = 0; layer < out.layers; ++layer)
    for (int y = 0; y < out.pixels; ++y)
      for (int x = 0; x < out.pixels; ++x) {
        LdmSum sum;
        for (int i = 0; i < pixel * pixel; ++i) {
          float open = 1;
          for (int part = 0; part < merged; ++part) {
            LdmTexel texel = image.at(layer * merged + part, x * pixel + i % pixel, y * pixel + i / pixel);
            const float alpha = static_cast<float>(texel.colour[3]) / 255;
            if (alpha == 0) continue;
            texel.depth = static_cast<std::uint8_t>((part * 255 + texel.depth) / merged);
            sum.add(texel, open * alpha);
            open *= 1 - alpha;
          }
        }
        if (sum.weight() == 0) continue;
        out.at(layer, x, y) = sum.mean(to_byte(255 * sum.weight() / static_cast<float>(pixel * pixel)));
      }
  return out;
}

LdmSquare halved(const LdmSquare& square) {
  LdmSquare half{square.side / 2, {}};
  half.texels.resize(static_cast<std::size_t>(half.side) * static_cast<std::size_t>(half.side));
  for (int y = 0; y < half.side; ++y)
    for (int x = 0; x < half.side; ++x)
      half.at(x, y) = ldm_mean({&square.at(2 * x, 2 * y), &square.at(2 * x + 1, 2 * y), &square.at(2 * x, 2 * y + 1),
                                &square.at(2 * x + 1, 2 * y + 1)});
  return half;
}

std::vector<LdmSquare> ldm_pyramid(LdmSquare block) {
  std::vector<LdmSquare> pyramid{std::move(block)};
  while (pyramid.back().side > 1) pyramid.push_back(halved(pyramid.back()));
  fill_empty(pyramid);
  return pyramid;
}

double colour_difference(const std::vector<LdmSquare>& pyramid, int m) {
  const LdmSquare &finest = pyramid[0], &coarse = pyramid[static_cast<std::size_t>(m)];
  double sum = 0, visible = 0;
  for (int y = 0; y < finest.side; ++y)
    for (int x = 0; x < finest.side; ++x) {
      visible += finest.at(x, y).colour[3] / 255.0;
      sum += difference(coarse.at(x >> m, y >> m), finest.at(x, y));
    }
  return visible > 0 ? sum / visible : 0;
}

int coarsest_level(const std::vector<LdmSquare>& pyramid, double delta) {
  int m = 0;
  while (m + 1 < static_cast<int>(pyramid.size()) && colour_difference(pyramid, m + 1) <= delta) ++m;
  return m;
}

}  // namespace manzana::foliage
