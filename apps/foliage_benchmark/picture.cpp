#include "apps/foliage_benchmark/picture.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage_benchmark {

Picture make_picture(int width, int height) {
  return {width, height, std::vector<Vec4>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

Vec3 seen_at(const Vec4& texel) { return Vec3(texel) + (1 - texel.w) * kSky; }

float to_srgb(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
}

float from_srgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

std::vector<unsigned char> to_rgb8(const Picture& picture) {
  std::vector<unsigned char> bytes;
  bytes.reserve(picture.texels.size() * 3);
  for (int y = picture.height - 1; y >= 0; --y) {
    for (int x = 0; x < picture.width; ++x) {
      const Vec3 light = seen_at(picture.at(x, y));
      for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<unsigned char>(std::lround(255 * to_srgb(light[c]))));
    }
  }
  return bytes;
}

}  // namespace manzana::foliage_benchmark
