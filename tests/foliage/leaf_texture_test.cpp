#include "foliage/leaf_texture.h"

#include <catch2/catch.hpp>

namespace manzana::foliage {
namespace {

// Dots of half a lattice cell: plain averaging would lose them all.
Image dots() {
  Image image;
  image.size = 256;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const int dx = x % 16 - 8 + y / 16 % 3, dy = y % 16 - 8;
      const bool leaf = dx * dx + dy * dy < 25;
      image.rgba.insert(image.rgba.end(), {80, 120, 40, static_cast<std::uint8_t>(leaf ? 255 : 0)});
    }
  }
  return image;
}

}  // namespace

TEST_CASE("mip levels stay as dense as the image") {
  const Image image = dots();
  const std::vector<Image> levels = coverage_mipmaps(image);
  REQUIRE(levels.size() == 9);
  const double coverage = alpha_coverage(image);
  CHECK((coverage > 0.2 && coverage < 0.4));
  for (const Image& level : levels) {
    INFO(level.size);
    if (level.size < 32) continue;  // a texel a dot: all are equal, and pass together
    // Ties at the threshold all pass, so some more may.
    CHECK(alpha_coverage(level) > coverage - 0.02);
    CHECK(alpha_coverage(level) < coverage + 0.12);
    CHECK(level.rgba[1] == 120);
  }
}

TEST_CASE("the smallest levels have the image's coverage as their mean alpha") {
  const Image image = dots();
  for (const Image& level : coverage_mipmaps(image)) {
    if (level.size > 8) continue;
    double sum = 0;
    for (std::size_t i = 3; i < level.rgba.size(); i += 4) sum += level.rgba[i];
    CHECK(sum / (255.0 * level.size * level.size) == Approx(alpha_coverage(image)).margin(0.003));
  }
}

TEST_CASE("transparent texels do not tint the levels") {
  Image image = dots();
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    if (image.rgba[i + 3] == 0) image.rgba[i] = image.rgba[i + 1] = image.rgba[i + 2] = 255;  // a white matte
  for (const Image& level : coverage_mipmaps(image))
    for (std::size_t i = 0; i < level.rgba.size(); i += 4)
      if (level.rgba[i + 3] > 0) REQUIRE(std::abs(level.rgba[i + 1] - 120) <= 1);
}

TEST_CASE("an image of nothing is white, an opaque one stays opaque") {
  CHECK(coverage_mipmaps({}).size() == 1);
  CHECK(resized({}, 8).rgba == std::vector<std::uint8_t>(256, 255));
  for (const Image& level : coverage_mipmaps(resized({}, 64)))
    CHECK(level.rgba == std::vector<std::uint8_t>(level.rgba.size(), 255));
  CHECK(resized(dots(), 64).rgba.size() == 4 * 64 * 64);
}

}  // namespace manzana::foliage
