#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "foliage/import/plant_image.h"
#include "foliage/leaf_image.h"

using namespace manzana::foliage;

namespace {
const std::uint8_t* texel(const Image& image, int x, int y) {
  return &image.rgba[static_cast<std::size_t>(4 * (y * image.size + x))];
}

int difference(const std::uint8_t* a, const std::uint8_t* b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}
}  // namespace

TEST_CASE("bytes of sRGB are those of its formula there and back") {
  const auto formula = [](float v) {  // IEC 61966-2-1
    const float s = v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
    return static_cast<int>(std::lround(s * 255));
  };
  for (int i = 0; i < 256; ++i) {
    const float v = static_cast<float>(i) / 255;
    const float linear = linear_of_srgb(static_cast<std::uint8_t>(i));
    CHECK(linear == (v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F)));
    CHECK(srgb_of_linear(linear) == i);
  }
  int wrong = 0;
  for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(1.0F); bits += bits < 0x38000000U ? 4093U : 61U) {
    const auto v = std::bit_cast<float>(bits);  // every 61st from 3e-5 on
    wrong += srgb_of_linear(v) != formula(v) ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(srgb_of_linear(-1) == 0);
  CHECK(srgb_of_linear(2) == 255);
  CHECK(srgb_of_linear(std::numeric_limits<float>::quiet_NaN()) == 0);
}

TEST_CASE("leaf images show leaves, green also where they are transparent, with a free border") {
  for (const char* shape : {"oval", "round", "lobed", "heart", "lance", "needle", "tuft", "frond"}) {
    INFO(shape);
    const Image image = leaf_image(shape, 0x4f7a35, 7);
    REQUIRE(image.size == 256);
    int opaque = 0, border = 0, not_leaf = 0;
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        const std::uint8_t* p = texel(image, x, y);
        opaque += p[3] >= 128;
        border += (x == 0 || y == 0 || x == 255) && p[3] != 0;
        not_leaf += p[3] == 0 && p[1] < 20;  // black fringe
      }
    }
    CHECK(opaque > 256 * 256 * 0.2);
    CHECK(opaque < 256 * 256 * 0.7);
    CHECK(border == 0);
    CHECK(not_leaf == 0);
  }
  CHECK_THROWS_AS(leaf_image("star", 0, 1), std::invalid_argument);
}

TEST_CASE("bark repeats without a seam") {
  const Image image = bark_image(0x6b5a48, 3);
  long inner = 0, seam = 0;
  for (int i = 0; i < 256; ++i) {
    for (int k = 0; k < 255; ++k)
      inner += difference(texel(image, k, i), texel(image, k + 1, i)) +
               difference(texel(image, i, k), texel(image, i, k + 1));
    seam += difference(texel(image, 255, i), texel(image, 0, i)) + difference(texel(image, i, 255), texel(image, i, 0));
  }
  CHECK(seam < 2.0 * static_cast<double>(inner) / 255);
}

TEST_CASE("dilate_colour takes the nearest colour") {
  Image image{8, std::vector<std::uint8_t>(8 * 8 * 4, 0)};
  for (const auto& [x, red] : {std::pair{0, 200}, std::pair{7, 50}}) {
    for (int y = 0; y < 8; ++y) {
      std::uint8_t* p = &image.rgba[static_cast<std::size_t>(4 * (y * 8 + x))];
      p[0] = static_cast<std::uint8_t>(red), p[3] = 255;
    }
  }
  dilate_colour(image);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      CHECK(texel(image, x, y)[0] == (x < 4 ? 200 : 50));
      CHECK(texel(image, x, y)[3] == (x == 0 || x == 7 ? 255 : 0));
    }
}

TEST_CASE("sRGB goes to linear light and back") {
  for (int v = 0; v < 256; ++v) CHECK(srgb_of_linear(linear_of_srgb(static_cast<std::uint8_t>(v))) == v);
  CHECK(linear_of_srgb(188) == Approx(0.5).margin(0.005));
}

TEST_CASE("pictures are averaged in linear light, with colour weighted by alpha") {
  // 512 wide: each texel is the mean of a black and a white pixel; linear 0.5 is 188.
  Picture stripes{512, 256, {}};
  for (int i = 0; i < 512 * 256; ++i) {
    const auto v = static_cast<std::uint8_t>(i % 2 ? 255 : 0);
    stripes.rgba.insert(stripes.rgba.end(), {v, v, v, 255});
  }
  CHECK(std::abs(plant_image(stripes, {}).rgba[0] - 188) <= 1);
  // A transparent black pixel beside an opaque red one: half alpha, full red.
  Picture edge{512, 256, {}};
  for (int i = 0; i < 512 * 256; ++i) {
    const auto v = static_cast<std::uint8_t>(i % 2 ? 255 : 0);
    edge.rgba.insert(edge.rgba.end(), {v, 0, 0, v});
  }
  const Image mask = plant_image(edge, {{1, 1, 1, 1}, 0.5F});
  CHECK(mask.rgba[0] == 255);
  CHECK(std::abs(mask.rgba[3] - 128) <= 1);
  CHECK(plant_image(edge, {}).rgba[3] == 255);                                   // opaque material
  CHECK(std::abs(plant_image(edge, {{1, 1, 1, 1}, 0.25F}).rgba[3] - 255) <= 1);  // cutoff mapped to one half
  CHECK(plant_image(plain_picture(), {{0, 1, 0, 1}, {}}).rgba[1] == 255);
}
