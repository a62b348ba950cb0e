#pragma once
/// What a plant looks like, in linear light, so that pictures can be averaged and compared.
#include <vector>

#include "culling/vec.h"

namespace manzana::foliage_benchmark {

/// Rows from the bottom, as GL has them. rgb: the plants' light, times the share w of the pixel that they cover.
struct Picture {
  int width = 0, height = 0;
  std::vector<Vec4> texels;
  Vec4& at(int x, int y) {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  const Vec4& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Picture make_picture(int width, int height);  ///< empty

/// Before a sky of one colour.
inline constexpr Vec3 kSky{0.42F, 0.56F, 0.76F};
Vec3 seen_at(const Vec4& texel);

float to_srgb(float linear);  ///< of [0, 1], clamped
float from_srgb(float encoded);

/// 8-bit sRGB before the sky, three bytes a pixel, rows from the top.
std::vector<unsigned char> to_rgb8(const Picture& picture);

}  // namespace manzana::foliage_benchmark
