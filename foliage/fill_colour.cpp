#include "foliage/fill_colour.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "foliage/leaf_image.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

using Corners = std::array<std::pair<std::uint16_t, std::uint16_t>, 4>;

std::set<Corners> different_uvs(std::span<const PlantQuad> leaves) {
  std::set<Corners> uvs;
  for (const PlantQuad& quad : leaves) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = {quad.corners[k].u, quad.corners[k].v};
    uvs.insert(corners);
  }
  return uvs;
}

std::size_t texel_at(int size, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
}

/// Texels with their middle in a quad, and those of its corners; nothing where the picture repeats.
std::vector<bool> used_texels(int size, std::span<const PlantQuad> leaves) {
  std::vector<bool> used(texel_at(size, 0, size), false);
  const auto to_texels = static_cast<float>(size) * kUvRange / 65535;
  const float end = static_cast<float>(size) * 1.001F;  // 1 is packed as a little more
  for (const Corners& corners : different_uvs(leaves)) {
    std::array<Vec2, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
      at[k] = Vec2(corners[k].first, corners[k].second) * to_texels;
      if (std::max(at[k].x, at[k].y) > end) return {};
      used[texel_at(size, std::min(static_cast<int>(at[k].x), size - 1),
                    std::min(static_cast<int>(at[k].y), size - 1))] = true;
    }
    for_each_quad_span(at, Form::triangle, size, [&](const PixelSpan& span, const QuadPart&) {
      for (int x = span.first; x < span.last; ++x) used[texel_at(size, x, span.y)] = true;
    });
  }
  return used;
}

/// Linear light times weight, and the weight; square.
struct Level {
  int size = 0;
  std::vector<Vec4> texels;
  Vec4& at(int x, int y) { return texels[texel_at(size, x, y)]; }
};

Level halved(Level& fine) {
  Level half{fine.size / 2, {}};
  for (int y = 0; y < half.size; ++y)
    for (int x = 0; x < half.size; ++x)
      half.texels.push_back(fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) + fine.at(2 * x, 2 * y + 1) +
                            fine.at(2 * x + 1, 2 * y + 1));
  return half;
}

Level weighted(const Image& image, const std::vector<bool>& used) {
  Level level{image.size, {}};
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::uint8_t* texel = &image.rgba[4 * i];
    const float weight = used[i] ? static_cast<float>(texel[3]) / 255 : 0;
    const Vec3 light(linear_of_srgb(texel[0]), linear_of_srgb(texel[1]), linear_of_srgb(texel[2]));
    level.texels.emplace_back(light * weight, weight);
  }
  return level;
}

/// Of a texel and the eight round it.
Vec4 next_to(Level& level, int x, int y) {
  Vec4 sum(0);
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, level.size - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, level.size - 1); ++i) sum += level.at(i, j);
  return sum;
}

/// Of those next to it, which filtering mixes with it: a leaf of one colour may have its one texel at the end of a
/// block. Where there are none, of the smallest block with some.
Vec4 round_it(std::vector<Level>& levels, int x, int y) {
  Vec4 sum = next_to(levels.front(), x, y);
  for (std::size_t i = 1; i < levels.size() && !(sum.w > 0); ++i) sum = levels[i].at(x >> i, y >> i);
  return sum;
}

}  // namespace

void fill_unused(Image& image, std::span<const PlantQuad> leaves) {
  if (image.size == 0) return;
  const std::vector<bool> used = used_texels(image.size, leaves);
  if (std::find(used.begin(), used.end(), false) == used.end()) return;
  std::vector<Level> levels{weighted(image, used)};
  while (levels.back().size > 1) levels.push_back(halved(levels.back()));
  for (int y = 0; y < image.size; ++y) {
    for (int x = 0; x < image.size; ++x) {
      if (used[texel_at(image.size, x, y)]) continue;
      const Vec4 sum = round_it(levels, x, y);
      if (!(sum.w > 0)) return;  // nothing has alpha
      for (int c = 0; c < 3; ++c)
        image.rgba[4 * texel_at(image.size, x, y) + static_cast<std::size_t>(c)] = srgb_of_linear(sum[c] / sum.w);
    }
  }
}

}  // namespace manzana::foliage
