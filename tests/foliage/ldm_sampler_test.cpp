// What a plant's slabs show, against cards whose answers are known.
#include "foliage/ldm_sampler.h"

#include <tbb/task_arena.h>

#include <catch2/catch.hpp>
#include <cstring>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/ldm_texture.h"
#include "foliage/make_ldm.h"
#include "foliage/plant_mesh.h"
#include "foliage/prepare.h"

namespace manzana::foliage {
namespace {

constexpr float kRadius = 4;
constexpr double kShare = 4.0 / (8 * 8);  // of the picture that a card covers
const ParallelView kFromSouth({0, -1, 0}, Vec3(0), kRadius, kLdmPixels);

/// Of x and z in [-1, 1], at that y, facing south; u to the east, v up.
PlantQuad card(float y, float slope = 0) {
  PlantQuad quad{};
  const std::array<Vec2, 4> corners{Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)};
  for (std::size_t c = 0; c < 4; ++c) {
    const Vec2 at = corners[c];
    quad.corners[c] = {{at.x, y + slope * at.x, at.y}, pack_uv(0.5F + 0.5F * at.x), pack_uv(0.5F + 0.5F * at.y)};
    quad.normals[c] = pack_normal({0, -1, 0});
    quad.shades[c] = 204;
  }
  return quad;
}

/// Red where u < 1/2, else a hole of green.
Image half_a_leaf() {
  Image image{256, {}};
  for (int i = 0; i < 256 * 256; ++i) {
    const bool red = i % 256 < 128;
    const std::array<std::uint8_t, 4> texel{static_cast<std::uint8_t>(red ? 200 : 0),
                                            static_cast<std::uint8_t>(red ? 0 : 90), 10,
                                            static_cast<std::uint8_t>(red ? 255 : 0)};
    image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
  }
  return image;
}

double cover(const LdmImage& image, int layer) {
  double sum = 0;
  for (int i = 0; i < kLdmPixels * kLdmPixels; ++i) sum += image.at(layer, i % kLdmPixels, i / kLdmPixels).colour[3];
  return sum / (255.0 * kLdmPixels * kLdmPixels);
}

}  // namespace

TEST_CASE("ldm sampler: a card is in its slab with its place and depth and normal and shade") {
  PreparedPlant plant;
  plant.bark = {card(1.0F)};
  const LdmImage image = LdmSampler(plant, 2)(kFromSouth, 4);  // slabs of 2 m, from y = -4 on
  const double share = kShare;
  for (int layer = 0; layer < 4; ++layer) CHECK(cover(image, layer) == Approx(layer == 2 ? share : 0).epsilon(0.01));
  const LdmTexel& middle = image.at(2, 120, 130);
  CHECK(middle.colour == std::array<std::uint8_t, 4>{255, 255, 255, 255});  // without a picture
  CHECK(middle.depth == 128);                                               // 1 m of 2
  CHECK(middle.shade == 102);                                               // 0.8 of 127, bark
  CHECK(glm::distance(unpack_ldm_normal(middle.normal_x, middle.normal_y), Vec3(0, -1, 0)) < 0.02F);
}

TEST_CASE("ldm sampler: of two cards the nearer hides the other, and a slanting one is cut at its slabs") {
  PreparedPlant plant;
  plant.bark = {card(1.5F), card(0.5F)};
  plant.leaf_image = half_a_leaf();
  CHECK(LdmSampler(plant, 1)(kFromSouth, 4).at(2, 128, 128).depth == 64);
  plant.bark = {card(0, 0.5F)};  // from y = -0.5 in the west to 0.5
  const LdmImage cut = LdmSampler(plant, 1)(kFromSouth, 4);
  CHECK(cover(cut, 1) == Approx(cover(cut, 2)).epsilon(0.05));
  CHECK(cut.at(1, 128 - 16, 128).colour[3] == 255);
  CHECK(cut.at(2, 128 - 16, 128).colour[3] == 0);
}

TEST_CASE("ldm sampler: a leaf has the holes and the colour of its picture") {
  PreparedPlant plant;
  plant.leaves = {card(1.0F)};
  plant.leaf_image = half_a_leaf();
  const LdmImage image = LdmSampler(plant, 2)(kFromSouth, 4);
  CHECK(cover(image, 2) == Approx(kShare / 2).epsilon(0.05));
  const LdmTexel& west = image.at(2, 128 - 16, 128);
  CHECK(west.colour == std::array<std::uint8_t, 4>{200, 0, 10, 255});
  CHECK(west.shade == 128 + 102);
  CHECK(image.at(2, 128 + 16, 128).colour[3] == 0);
}

TEST_CASE("ldm sampler: one thread and many make the same") {
  const PreparedPlant plant = prepare(grow_plant(builtin_species("birch"), 1), {.visibility_side = 0});
  const Ball ball = ldm_ball(plant);
  const ParallelView view({0, 0, 1}, ball.centre, ball.radius, kLdmPixels);
  const LdmSampler sampler(plant, 2);
  const LdmImage many = sampler(view, 6);
  tbb::task_arena arena(1);
  const LdmImage one = arena.execute([&] { return sampler(view, 6); });
  bool same = true;
  for (std::size_t i = 0; i < many.texels.size(); ++i)
    same = same && std::memcmp(&many.texels[i], &one.texels[i], sizeof(LdmTexel)) == 0;
  CHECK(same);
  CHECK(cover(many, 0) > 0);
}

}  // namespace manzana::foliage
