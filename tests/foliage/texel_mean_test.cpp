// Colour and alpha under a triangle against a 64 times supersampled integration in double (numerics.md 16).
#include "foliage/texel_mean.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

constexpr double kTolerance = 1.0 / 255;

double to_linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
double from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Image random_image(int size, std::uint64_t seed) {
  Image image{size, {}};
  Random random(seed);
  for (int i = 0; i < size * size; ++i) {
    for (int k = 0; k < 3; ++k) image.rgba.push_back(static_cast<std::uint8_t>(random.bits() & 255));
    image.rgba.push_back(random.uniform() < 0.3F ? 0 : static_cast<std::uint8_t>(random.bits() & 255));
  }
  return image;
}

/// 64 samples along each side of a texel, or as many over the whole triangle if that is smaller.
TexelMean supersampled(const Image& image, const std::array<Vec2d, 3>& uv) {
  const double side = image.size;
  const Vec2d e = (uv[1] - uv[0]) * side, f = (uv[2] - uv[0]) * side;
  const int steps = std::min(64 * static_cast<int>(std::ceil(std::max(glm::length(e), glm::length(f)))), 2048);
  double alpha = 0, samples = 0, square = 0;
  const std::vector<float> light = smooth_luminance(image);
  Vec3d colour(0), middle(0);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      double b = (i + 0.5) / steps, c = (j + 0.5) / steps;
      if (b + c > 1) b = 1 - b, c = 1 - c;  // the other half of the parallelogram, folded over
      const Vec2d at = uv[0] * side + e * b + f * c;
      const auto wrapped = [&](double v) {
        return static_cast<std::size_t>(std::floor(v - std::floor(v / side) * side));
      };
      const std::size_t place = wrapped(at.y) * static_cast<std::size_t>(image.size) + wrapped(at.x);
      const std::uint8_t* texel = &image.rgba[4 * place];
      const double a = texel[3] / 255.0;
      alpha += a;
      square += a * static_cast<double>(light[place] * light[place]);
      samples += 1;
      for (int k = 0; k < 3; ++k) colour[k] += a * to_linear(texel[k] / 255.0);
      middle += a * Vec3d(1 - b - c, b, c);
    }
  if (alpha == 0) return {};
  return {colour / alpha, alpha / samples, square / alpha, middle / alpha};
}

}  // namespace

TEST_CASE("the mean of texels is that of many samples") {
  const Image image = random_image(16, 1);
  const TexelMeans means(image);
  Random random(2);
  for (int n = 0; n < 60; ++n) {
    // From below a texel to the whole picture and past its edges.
    const float size = n % 3 == 0 ? 0.03F : n % 3 == 1 ? 0.3F : 1.5F;
    const Vec2d place{random.uniform() * 2, random.uniform() * 2};
    std::array<Vec2d, 3> uv;
    for (Vec2d& p : uv) p = place + Vec2d(random.spread(size), random.spread(size));
    const TexelMean mean = means.over(uv), oracle = supersampled(image, uv);
    INFO(n << " size " << size);
    CHECK(mean.alpha == Approx(oracle.alpha).margin(kTolerance));
    if (oracle.alpha < 0.02) continue;  // few samples see anything
    CHECK(mean.square == Approx(oracle.square).margin(kTolerance));
    for (int k = 0; k < 3; ++k) {
      CHECK(from_linear(mean.colour[k]) == Approx(from_linear(oracle.colour[k])).margin(kTolerance));
      CHECK(mean.middle[k] == Approx(oracle.middle[k]).margin(0.01));
    }
  }
}

TEST_CASE("the mean of texels where little or nothing is seen") {
  Image image{4, std::vector<std::uint8_t>(64, 0)};
  const std::array<Vec2d, 3> all{Vec2d{0, 0}, Vec2d{2, 0}, Vec2d{0, 2}};
  CHECK(TexelMeans(image).over(all).alpha == 0);
  image.rgba[4 * 5] = 200, image.rgba[4 * 5 + 3] = 1;  // texel (1, 1), alpha 1 / 255
  const TexelMean faint = TexelMeans(image).over(all);
  CHECK(faint.alpha == Approx(1.5 / 255 / 16));  // it is seen in three tiles of an area of two
  CHECK(from_linear(faint.colour.x) == Approx(200.0 / 255));
  CHECK(faint.colour.y == 0);
  // Degenerate: the texel at the middle.
  const Vec2d in{1.5 / 4, 1.5 / 4};
  CHECK(TexelMeans(image).over({in, in, in}).alpha == Approx(1.0 / 255));
  CHECK(TexelMeans(image).over({Vec2d(0), Vec2d(0), Vec2d(0)}).alpha == 0);
}

TEST_CASE("the mean of texels of one texel and of eight thousand") {
  const Image one{1, {10, 20, 30, 128}};
  const TexelMean mean = TexelMeans(one).over({Vec2d{.1, .2}, Vec2d{3.9, .2}, Vec2d{.1, 7}});
  CHECK(mean.alpha == Approx(128 / 255.0));
  CHECK(mean.colour.z == Approx(to_linear(30 / 255.0)));
  CHECK(mean.middle.x == Approx(1.0 / 3));
  Image large{8192, std::vector<std::uint8_t>(std::size_t{8192} * 8192 * 4, 255)};
  const TexelMean white = TexelMeans(large).over({Vec2d{.1, .1}, Vec2d{.11, .1}, Vec2d{.1, .11}});
  CHECK(white.alpha == Approx(1));
  CHECK(white.colour.x == Approx(1));
}

TEST_CASE("smooth luminance is that of squares of texels, by alpha") {
  Image image{8, std::vector<std::uint8_t>(256, 0)};
  const auto set = [&](int x, int y, std::uint8_t value, std::uint8_t alpha) {
    for (std::size_t k = 0; k < 4; ++k)
      image.rgba[static_cast<std::size_t>(4 * (8 * y + x)) + k] = k < 3 ? value : alpha;
  };
  set(0, 0, 255, 255);
  set(3, 3, 0, 255);
  set(4, 0, 255, 51);
  const std::vector<float> light = smooth_luminance(image);
  CHECK(light[0] == Approx(0.5));
  CHECK(light[8 * 3 + 3] == Approx(0.5));
  CHECK(light[8 * 2 + 7] == Approx(1));
  CHECK(light[8 * 7 + 7] == 0);
  CHECK(smooth_luminance(Image{}) == std::vector<float>{1});
}

TEST_CASE("light is mixed as light") {
  const Image two{2, {20, 20, 20, 255, 200, 200, 200, 255, 20, 20, 20, 255, 200, 200, 200, 255}};
  const TexelMean mean = TexelMeans(two).over({Vec2d{0, 0}, Vec2d{1, 0}, Vec2d{.5, 1}});
  CHECK(from_linear(mean.colour.x) * 255 == Approx(147).margin(1));
}

}  // namespace manzana::foliage
