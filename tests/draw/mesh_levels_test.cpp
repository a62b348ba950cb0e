// Levels of buildings: which is drawn, what is held of them, and the way from one to the next. A building that is grey
// in full is red at its level, so that pictures tell.
#include <catch2/catch.hpp>
#include <cmath>

#include "gl/context.h"
#include "scenegraph/draw/city_meshes.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"

namespace manzana::draw {
namespace {

constexpr Size kSize{320, 240};
constexpr double kError = 1;  // pixels

/// A house of 10 x 10 x 12 m; in full each triangle is there twice.
Scene house() {
  HandMesh full = make_box({0, 60, 0}, {10, 10, 12}, 0x808080, Material::concrete);
  full.indices.insert(full.indices.end(), full.indices.begin(), full.indices.end());
  HandBlock block;
  block.buildings = {full};
  Scene scene = make_scene({block});
  MeshLayer& layer = scene.buildings;
  for (std::size_t l = 0; l < kMeshLevels; ++l)
    layer.levels[l].index_first = {0, l == 1 ? layer.index_first[1] / 2 : 0};
  MeshRows& level = layer.levels[1];
  for (CityVertex v : layer.mesh.vertices) {
    v.colour = pack_colour(0xc00000, Material::concrete);
    level.mesh.vertices.own().push_back(v);
  }
  for (std::uint32_t i = 0; i < level.index_first[1]; ++i) level.mesh.indices.own().push_back(layer.mesh.indices[i]);
  return scene;
}

struct Stage {
  const Scene scene = house();
  const culling::View view = look_in(scene.blocks[0], {3, 0, 5}, {0, 1, 0}, 25, 4.0 / 3.0);
  VisibleSets sets = visible(scene, view, Structure::bqr);
  double f_px = focal_px(camera_of(view), kSize.height);

  /// The error that is tolerated chooses, so the camera may stand still: the level is as if it were first drawn at
  /// `times` the distance of the house.
  DrawOptions from(double times) const {
    const double away = LayerPieces(scene.buildings, scene.tree.origin).boxes[0].min.y - view.eye.y;
    DrawOptions options;
    options.layers.sky = options.layers.fog = false;
    options.tree_error_px = kMeshLevelErrors[1] * f_px / (away * times);
    return options;
  }
};

}  // namespace

TEST_CASE("levels: a building is drawn in full when near and by its level alone when far") {
  const gl::HeadlessContext context;
  const Stage stage;
  Renderer renderer(stage.scene, simple_plants(), {.samples = 1});
  const auto red = [&](const DrawOptions& options) {
    return reddish(take_picture(renderer, kSize, stage.scene, stage.sets, stage.view, options).at(160, 120));
  };
  CHECK(!red(stage.from(1.01)));
  CHECK(red(stage.from(0.99 / kLevelFade)));
  DrawOptions all = stage.from(0.01);
  CHECK(red(all));
  all.tree_law = foliage::Law::full;
  CHECK(!red(all));
}

TEST_CASE("levels: what is far holds its level alone and what cannot come yet is shown as what is there") {
  const gl::HeadlessContext context;
  const Stage stage;
  Renderer renderer(stage.scene, simple_plants(), {.samples = 1});
  renderer.resize(kSize);
  DrawOptions far = stage.from(0.1), near = stage.from(10);
  const FrameCounts level = renderer.draw(stage.scene, stage.sets, stage.view, far);
  const std::size_t held = renderer.memory().meshes_held;
  CHECK(level.triangles == 10);
  CHECK(held < renderer.memory().meshes_all);
  near.upload_bytes = 0;
  const FrameCounts waiting = renderer.draw(stage.scene, stage.sets, stage.view, near);
  CHECK(waiting.bytes_to_bring > 0);
  CHECK(waiting.triangles == 10);
  near.upload_bytes = 1'000'000;
  CHECK(renderer.draw(stage.scene, stage.sets, stage.view, near).triangles == 20);
  CHECK(renderer.memory().meshes_held == held + renderer.memory().meshes_all);
}

TEST_CASE("levels: a building between two is picked and painted as any other") {
  const gl::HeadlessContext context;
  const Stage stage;
  Renderer renderer(stage.scene, simple_plants(), {.samples = 1});
  for (const double times : {2.0, 0.9, 0.1}) {
    take_picture(renderer, kSize, stage.scene, stage.sets, stage.view, stage.from(times));
    CHECK(renderer.pick(stage.scene, stage.sets, camera_of(stage.view), {160, 120, 1, 1}).at(0) == 1);
  }
  renderer.paint_buildings(stage.scene, std::vector<std::uint32_t>{0x0000c0});
  for (const double times : {2.0, 0.9, 0.1})
    CHECK(bluish(take_picture(renderer, kSize, stage.scene, stage.sets, stage.view, stage.from(times)).at(160, 120)));
}

TEST_CASE("levels: between two each sample shows one of them") {
  const gl::HeadlessContext context;
  const Stage stage;
  for (const int samples : {1, 4}) {
    Renderer renderer(stage.scene, simple_plants(), {.samples = samples});
    const auto drawn = [&](double times) {
      return take_picture(renderer, kSize, stage.scene, stage.sets, stage.view, stage.from(times));
    };
    const Picture full = drawn(1.01), level = drawn(0.99 / kLevelFade);
    for (const double share : {0.25, 0.5, 0.75}) {
      INFO("samples " << samples << ", share " << share);
      const Picture between = drawn(1 / (kLevelFade - share * (kLevelFade - 1)));
      int neither = 0, house = 0;
      double of_level = 0;
      for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
          const auto a = full.at(x, y), b = level.at(x, y), c = between.at(x, y);
          if (a == b) {
            neither += c != a;
            continue;
          }
          ++house;
          if (samples == 1) neither += c != a && c != b;
          of_level += static_cast<double>(a[1] - c[1]) / (a[1] - b[1]);  // of green
        }
      CHECK(neither == 0);
      CHECK(house > 3000);
      if (samples == 1) CHECK(std::abs(of_level / house - (1 - share)) < 0.03);
      if (samples > 1) CHECK((of_level > 0.05 * house && of_level < 0.95 * house));
    }
  }
}

}  // namespace manzana::draw
