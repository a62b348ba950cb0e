#pragma once
/// Slabs made by hand, for packs without a GPU.
#include "foliage/make_ldm.h"
#include "tests/support/random.h"

namespace manzana::foliage {

inline Vec3 random_direction(support::Random& random) {
  Vec3 d(0);
  while (glm::length(d) < 0.1F) d = Vec3(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1));
  return glm::normalize(d);
}

/// Blobs of leaves in every layer, some of them over each other.
inline LdmImage blobs(int layers, std::uint64_t seed, int count = 60) {
  LdmImage image(layers);
  support::Random random(seed);
  for (int i = 0; i < count; ++i) {
    const int layer = random.below(layers);
    const int x0 = random.below(kLdmPixels), y0 = random.below(kLdmPixels);
    const int r = 2 + random.below(24);
    const auto green = static_cast<std::uint8_t>(60 + random.below(150));
    const auto depth = random.below(200);
    for (int y = std::max(0, y0 - r); y < std::min(kLdmPixels, y0 + r); ++y)
      for (int x = std::max(0, x0 - r); x < std::min(kLdmPixels, x0 + r); ++x) {
        if ((x - x0) * (x - x0) + (y - y0) * (y - y0) > r * r) continue;
        LdmTexel& texel = image.at(layer, x, y);
        texel.colour = {40, green, 30, static_cast<std::uint8_t>(x % 3 == 0 ? 128 : 255)};
        texel.depth = static_cast<std::uint8_t>(std::min(255, depth + std::abs(x - x0)));
        texel.shade = 128 + 100;
      }
  }
  return image;
}

/// A white card across the ball's middle, from whatever side.
inline LdmImage white_card(const ParallelView&, int layers) {
  LdmImage image(layers);
  for (int y = 0; y < kLdmPixels; ++y)
    for (int x = 0; x < kLdmPixels; ++x) image.at(layers / 2, x, y) = {{255, 255, 255, 255}, 128, 128, 0, 127};
  return image;
}

inline LdmPack pack_of_blobs(const LdmOptions& options = {}, LdmTally* tally = nullptr) {
  std::uint64_t seed = 0;
  const auto sample = [&](const ParallelView&, int layers) { return blobs(layers, ++seed); };
  return make_ldm_pack({Vec3(0, 0, 5), 6}, options, sample, {}, tally);
}

}  // namespace manzana::foliage
