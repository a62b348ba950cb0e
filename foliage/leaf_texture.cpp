#include "foliage/leaf_texture.h"

#include <algorithm>
#include <cmath>

#include "foliage/leaf_image.h"

namespace manzana::foliage {
namespace {

constexpr int kBlurredSize = 8;  // from level 5 on, foliage/shaders/cover.glsl takes alpha as it is
constexpr int kPasses = 128;     // alpha of one half

std::size_t at(const Image& image, int x, int y) {
  return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size) + static_cast<std::size_t>(x));
}

Image make_image(int size) {
  Image image;
  image.size = size;
  image.rgba.assign(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 255);
  return image;
}

/// Colours count by their alpha: what cannot be seen near does not tint what is seen far.
void average(const Image& image, int x, int y, const LinearBytes& linear, std::uint8_t* texel) {
  Vec3 weighted(0), plain(0);
  float alpha = 0;
  for (int k = 0; k < 4; ++k) {
    const std::uint8_t* from = &image.rgba[at(image, 2 * x + k % 2, 2 * y + k / 2)];
    const Vec3 light(linear[from[0]], linear[from[1]], linear[from[2]]);
    alpha += from[3];
    weighted += light * static_cast<float>(from[3]);
    plain += light / 4.0F;
  }
  const Vec3 mean = alpha > 0 ? weighted / alpha : plain;
  for (int c = 0; c < 3; ++c) texel[c] = srgb_of_linear(mean[c]);
  texel[3] = static_cast<std::uint8_t>(std::lround(alpha / 4));
}

Image halved(const Image& image) {
  const LinearBytes& linear = linear_of_srgb();
  Image half = make_image(image.size / 2);
  for (int y = 0; y < half.size; ++y) {
    for (int x = 0; x < half.size; ++x) average(image, x, y, linear, &half.rgba[at(half, x, y)]);
  }
  return half;
}

// The texel that must just pass so that `coverage` of all do: alpha is scaled to bring it to one half.
void keep_coverage(Image& image, double coverage) {
  std::vector<std::uint8_t> alphas;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) alphas.push_back(image.rgba[i]);
  std::sort(alphas.rbegin(), alphas.rend());
  const auto passing = static_cast<std::size_t>(std::lround(coverage * static_cast<double>(alphas.size())));
  if (passing == 0 || alphas[passing - 1] == 0) return;
  const bool kept = alphas[passing - 1] >= kPasses && (passing == alphas.size() || alphas[passing] < kPasses);
  if (kept) return;
  const double scale = kPasses / static_cast<double>(alphas[passing - 1]);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    image.rgba[i] = static_cast<std::uint8_t>(std::min(255L, std::lround(image.rgba[i] * scale)));
  }
}

/// Its mean alpha becomes the coverage, unless a texel would have more than all.
void keep_mean(Image& image, double coverage) {
  double sum = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  const double factor = sum > 0 ? coverage * 255 * static_cast<double>(image.rgba.size() / 4) / sum : 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    image.rgba[i] = static_cast<std::uint8_t>(std::lround(std::min(255.0, image.rgba[i] * factor)));
}

}  // namespace

double alpha_coverage(const Image& image) {
  if (image.rgba.empty()) return 0;
  std::size_t passing = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) passing += image.rgba[i] >= kPasses ? 1 : 0;
  return 4 * static_cast<double>(passing) / static_cast<double>(image.rgba.size());
}

std::vector<Image> coverage_mipmaps(const Image& image) {
  std::vector<Image> levels{image.size > 0 ? image : make_image(1)};
  const double coverage = alpha_coverage(levels.front());
  Image plain = levels.front();
  while (plain.size > 1) {
    plain = halved(plain);
    levels.push_back(plain);
    if (plain.size > kBlurredSize)
      keep_coverage(levels.back(), coverage);
    else
      keep_mean(levels.back(), coverage);
  }
  return levels;
}

Image resized(const Image& image, int size) {
  if (image.size == size) return image;
  Image result = make_image(size);
  for (int y = 0; image.size > 0 && y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const std::size_t from = at(image, x * image.size / size, y * image.size / size);
      std::copy_n(&image.rgba[from], 4, &result.rgba[at(result, x, y)]);
    }
  }
  return result;
}

}  // namespace manzana::foliage
