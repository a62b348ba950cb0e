#include "foliage/fill_colour.h"

#include <catch2/catch.hpp>

#include "foliage/leaf_image.h"
#include "foliage/plant_mesh.h"

namespace manzana::foliage {
namespace {

/// Green all over, yellow where u < 1/2.
Image half_yellow(std::uint8_t alpha) {
  Image image{16, {}};
  for (int i = 0; i < 256; ++i) {
    const bool yellow = i % 16 < 8;
    for (const int v : {yellow ? 200 : 0, yellow ? 180 : 120, 0}) image.rgba.push_back(static_cast<std::uint8_t>(v));
    image.rgba.push_back(alpha);
  }
  return image;
}

PlantQuad quad_over(float low, float high) {
  PlantQuad quad{};
  const std::array<Vec2, 4> uv{Vec2(low, low), Vec2(high, low), Vec2(high, high), Vec2(low, high)};
  for (std::size_t k = 0; k < 4; ++k) quad.corners[k].u = pack_uv(uv[k].x), quad.corners[k].v = pack_uv(uv[k].y);
  return quad;
}

const std::uint8_t* texel(const Image& image, int x, int y) {
  return &image.rgba[static_cast<std::size_t>(4 * (16 * y + x))];
}

}  // namespace

TEST_CASE("what no leaf shows of an opaque picture takes the colour of what leaves show") {
  Image image = half_yellow(255);
  const Image before = image;
  const std::array leaves{quad_over(0.05F, 0.45F), quad_over(0.05F, 0.45F)};
  fill_unused(image, leaves);
  CHECK(texel(image, 12, 3)[0] == 200);
  CHECK(texel(image, 15, 15)[1] == 180);
  for (int x = 1; x < 7; ++x) CHECK(texel(image, x, 3)[0] == texel(before, x, 3)[0]);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) REQUIRE(image.rgba[i] == 255);
}

TEST_CASE("what filtering mixes with the one texel of a leaf of one colour has its colour") {
  Image image = half_yellow(255);
  fill_unused(image, std::array{quad_over(0.25F, 0.25F), quad_over(0.5F, 0.5F), quad_over(0.75F, 0.75F)});
  for (const int at : {4, 8, 12})
    for (const int x : {at - 1, at})
      for (const int y : {at - 1, at}) CHECK(texel(image, x, y)[0] == (at < 8 ? 200 : 0));
}

TEST_CASE("pictures that leaves show whole or more than once stay as they are") {
  for (const float high : {1.0F, 2.5F}) {
    Image image = half_yellow(255);
    const Image before = image;
    fill_unused(image, std::array{quad_over(0, high)});
    CHECK(image.rgba == before.rgba);
  }
}

TEST_CASE("a picture that is transparent where leaves are and one without leaves stay as they are") {
  Image image = half_yellow(0);
  const Image before = image;
  fill_unused(image, std::array{quad_over(0.1F, 0.3F)});
  CHECK(image.rgba == before.rgba);
  Image none;
  fill_unused(none, std::array{quad_over(0, 1)});
  CHECK(none.rgba.empty());
  Image opaque = half_yellow(255);
  fill_unused(opaque, {});
  CHECK(opaque.rgba == half_yellow(255).rgba);
}

}  // namespace manzana::foliage
