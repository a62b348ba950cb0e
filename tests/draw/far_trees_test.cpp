// Trees that turn into mosaics as they become small.
#include "scenegraph/draw/far_trees.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/far_pack.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"

namespace manzana::draw {
namespace {

constexpr Size kSize{360, 240};
constexpr float kHeight = 11;

Quality sampled(int samples) {
  Quality quality;
  quality.samples = samples;
  return quality;
}

/// Side by side, so far away that they are about as high as that in a picture of kSize.
Scene make_row(int trees, double height_px) {
  HandBlock block;
  const double focal = kSize.height / (2 * std::tan(30 * 3.14159265358979 / 180));
  for (int i = 0; i < trees; ++i) {
    TreeInstance tree;
    tree.position = {9 * (static_cast<float>(i) - 0.5F * static_cast<float>(trees - 1)),
                     static_cast<float>(static_cast<double>(kHeight) * focal / height_px), 0};
    tree.height_m = kHeight;
    tree.crown_radius_m = 4;
    tree.yaw = static_cast<float>(i);
    block.trees.push_back(tree);
  }
  return make_scene({block});
}

/// Trees alone, before black.
Picture picture_of(Renderer& renderer, const Scene& scene, bool mosaics, double error_px = 1, double wind = 0,
                   double seconds = 0) {
  DrawOptions options;
  options.mosaics = mosaics;
  options.tree_error_px = error_px;
  options.wind = wind;
  options.seconds = seconds;
  options.layers = {.buildings = false, .surfaces = false, .trees = true, .cars = false, .sky = false, .fog = false};
  options.transparent = true;
  const culling::View view = look_in(scene.blocks[0], {0, 0, kHeight / 2}, {0, 1, 0}, 60, 1.5);
  return take_picture(renderer, kSize, scene, visible(scene, view, Structure::none), view, options);
}

/// Of the upper half of all that is light, pixels from the left.
double middle_of_tops(const Picture& picture) {
  double sum = 0, light = 0;
  for (int y = 0; y < picture.height / 2; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double here = std::pow(picture.at(x, y)[1] / 255.0, 2.2);
      sum += here, light += here * x;
    }
  return light / sum;
}

double light_of(const Picture& picture) {
  double sum = 0;
  for (const unsigned char byte : picture.rgb) sum += std::pow(byte / 255.0, 2.2);
  return sum;
}

}  // namespace

TEST_CASE("far trees: a pack is asked for once trees are small and until it is there") {
  const gl::HeadlessContext context;
  const auto plants = simple_plants();
  const Scene near = make_row(2, 100), far = make_row(2, 20);
  Renderer of_near(near, plants, sampled(1)), of_far(far, plants, sampled(1));
  picture_of(of_near, near, true);
  CHECK(of_near.packs_wanted().empty());
  picture_of(of_far, far, false);
  CHECK(of_far.packs_wanted().empty());
  picture_of(of_far, far, true);
  REQUIRE(of_far.packs_wanted().size() == 1);
  const std::uint32_t plant = of_far.packs_wanted()[0];
  of_far.add_pack(plant, make_far_pack(plants[plant]));
  picture_of(of_far, far, true);
  CHECK(of_far.packs_wanted().empty());
  CHECK(of_far.trees_shown().leaves + of_far.trees_shown().bark + of_far.trees_shown().points == 0);
}

TEST_CASE("far trees: a crown is as opaque on the way to mosaics as before and after") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  const auto plants = simple_plants();
  constexpr double kError = 4;
  const foliage::LdmPack pack = make_far_pack(plants[0]);
  for (double height = 1.1 * no_mosaics(kAllMosaics); height > 0.9 * kAllMosaics; height -= 1.5) {
    const Scene scene = make_row(1, kError * height);
    Renderer renderer(scene, plants, sampled(1));
    renderer.add_pack(0, pack);
    const Picture without = picture_of(renderer, scene, false, kError);
    const Picture with = picture_of(renderer, scene, true, kError);
    CAPTURE(height);
    int bare = 0, inside = 0;
    for (int y = kSize.height / 2 - 20; y < kSize.height / 2 + 10; ++y)
      for (int x = kSize.width / 2 - 8; x < kSize.width / 2 + 8; ++x) {
        const int expected = without.at(x, y)[1], seen = with.at(x, y)[1];
        inside += expected > 40 ? 1 : 0;
        bare += expected > 40 && seen < 0.8 * expected ? 1 : 0;
      }
    CHECK(inside > 100);
    CHECK(bare <= inside / 50);  // where a picture's edge lies elsewhere
  }
  CHECK(log.messages().empty());
}

TEST_CASE("far trees: wind moves mosaics as it moves the trees that they take over from") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  constexpr double kError = 5;
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  plants[0] = prepare(grow_plant(foliage::builtin_species("oak"), 3), {.visibility_side = 0});
  const Scene scene = make_row(1, 0.95 * kError * kAllMosaics);
  Renderer renderer(scene, plants, sampled(4));
  renderer.add_pack(0, make_far_pack(plants[0]));
  const auto moved = [&](bool mosaics, double seconds) {
    return middle_of_tops(picture_of(renderer, scene, mosaics, kError, 1, seconds)) -
           middle_of_tops(picture_of(renderer, scene, mosaics, kError, 0, 0));
  };
  double most = 0;
  for (double seconds = 0; seconds < 8; seconds += 1.3) {
    const double trees = moved(false, seconds), mosaics = moved(true, seconds);
    CAPTURE(seconds, trees);
    most = std::max(most, std::abs(trees));
    CHECK(std::abs(mosaics - trees) < 0.12);  // pixels: boughs move near ones besides
  }
  CHECK(most > 0.2);
  CHECK(log.messages().empty());
}

TEST_CASE("far trees: as much light comes from trees as mosaics take over") {
  const gl::HeadlessContext context;
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  plants[0] = prepare(grow_plant(foliage::builtin_species("oak"), 3), {.visibility_side = 0});
  const foliage::LdmPack pack = make_far_pack(plants[0]);
  for (const double height : {31.0, 29.0, 27.0, 25.0, 22.0}) {
    const Scene scene = make_row(10, height);
    Renderer renderer(scene, plants, sampled(4));
    renderer.add_pack(0, pack);
    const double full = light_of(picture_of(renderer, scene, false, 0.01));
    CAPTURE(height);
    CHECK(light_of(picture_of(renderer, scene, true)) ==
          Approx(full).epsilon(0.05));  // four samples a pixel, ten trees
  }
}

}  // namespace manzana::draw
