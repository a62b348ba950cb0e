#include <algorithm>
#include <array>
#include <cmath>

#include "foliage/leaf_image.h"
#include "foliage/random.h"

namespace manzana::foliage {
namespace {

/// Value noise that repeats after `period_x` and `period_y` cells; [0, 1].
float noise(float x, float y, int period_x, int period_y, std::uint64_t seed) {
  const auto ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
  const auto corner = [&](int dx, int dy) {
    const int cx = (ix + dx) % period_x, cy = (iy + dy) % period_y;
    return Random(hash(seed, static_cast<std::uint64_t>(cy) * 4096 + static_cast<std::uint64_t>(cx))).uniform();
  };
  const auto smooth = [](float f) { return f * f * (3 - 2 * f); };
  const float fx = smooth(x - std::floor(x)), fy = smooth(y - std::floor(y));
  return glm::mix(glm::mix(corner(0, 0), corner(1, 0), fx), glm::mix(corner(0, 1), corner(1, 1), fx), fy);
}

/// Height of the bark in [0, 1]: ridges along y with cracks between them, and a fine grain.
float bark_height(float u, float v, std::uint64_t seed) {
  const float bend = noise(u * 6, v * 4, 6, 4, hash(seed, 9)) - 0.5F;
  float x = u * 14 + 2.2F * bend;
  x -= 14 * std::floor(x / 14);
  const float ridge = 1 - std::abs(2 * noise(x, v * 5, 14, 5, seed) - 1);
  const float cracks = 1 - std::abs(2 * noise(u * 10, v * 12, 10, 12, hash(seed, 3)) - 1);
  const float grain = noise(u * 64, v * 40, 64, 40, hash(seed, 5));
  return std::clamp(0.55F * ridge + 0.25F * cracks + 0.2F * grain, 0.0F, 1.0F);
}

}  // namespace

void dilate_colour(Image& image) {
  const int n = image.size;
  std::vector<std::uint32_t> queue;  // breadth first from the texels that have a colour
  std::vector<bool> known(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), false);
  for (std::uint32_t i = 0; i < known.size(); ++i) {
    if (image.rgba[4 * std::size_t{i} + 3] == 0) continue;
    known[i] = true;
    queue.push_back(i);
  }
  if (queue.empty()) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? 0 : 128;
    return;
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const int x = static_cast<int>(queue[head]) % n, y = static_cast<int>(queue[head]) / n;
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
      if (x + dx < 0 || x + dx >= n || y + dy < 0 || y + dy >= n) continue;
      const auto next = static_cast<std::uint32_t>((y + dy) * n + x + dx);
      if (known[next]) continue;
      known[next] = true;
      std::copy_n(&image.rgba[4 * std::size_t{queue[head]}], 3, &image.rgba[4 * std::size_t{next}]);
      queue.push_back(next);
    }
  }
}

Image bark_image(std::uint32_t rgb, std::uint64_t seed) {
  const Vec3 colour = linear_of_rgb(rgb);
  Image image{kPlantImageSize, std::vector<std::uint8_t>(std::size_t{4} * kPlantImageSize * kPlantImageSize, 255)};
  std::uint8_t* texel = image.rgba.data();
  for (int y = 0; y < kPlantImageSize; ++y) {
    for (int x = 0; x < kPlantImageSize; ++x) {
      const float u = static_cast<float>(x) / kPlantImageSize, v = static_cast<float>(y) / kPlantImageSize;
      const float light = 0.45F + 1.0F * bark_height(u, v, seed);
      for (int c = 0; c < 3; ++c) texel[c] = srgb_of_linear(colour[c] * light);
      texel += 4;
    }
  }
  return image;
}

}  // namespace manzana::foliage
