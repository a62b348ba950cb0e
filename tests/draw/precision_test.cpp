// What floats do to the picture, far from the origin and far from the eye.  [numerics 7]
#include <catch2/catch.hpp>

#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"

namespace manzana::draw {
namespace {

constexpr Size kSize{320, 240};
constexpr double kAspect = 4.0 / 3.0;

double side_of(const Vec2d& a, const Vec2d& b, const Vec2d& p) {  // pixels to the left of the line from a to b
  const Vec2d along = glm::normalize(b - a);
  return along.x * (p.y - a.y) - along.y * (p.x - a.x);
}

HandBlock moved(HandBlock block, const Vec2d& plan) {
  block.plan = plan;
  return block;
}

}  // namespace

TEST_CASE("edges lie within 0.1 px of where exact arithmetic puts them, wherever on the Earth") {
  const gl::HeadlessContext context;
  // A leaning quadrilateral facing south; its edges cross pixel centres at all fractions.
  const std::array<Vec3, 4> corner{Vec3(-0.61F, 0, 0.32F), Vec3(0.58F, 0, 0.37F), Vec3(0.63F, 0, 1.17F),
                                   Vec3(-0.55F, 0, 1.24F)};
  for (const double where : {0.0, 1e4, 1e5, 4.6e6}) {
    for (const double distance : {2.0, 20.0, 200.0}) {
      INFO(where << " m from the origin, seen from " << distance << " m");
      HandBlock block;
      const auto grow = static_cast<float>(distance / 2);
      HandMesh quad;
      add_quad(quad, grow * corner[0], grow * corner[1], grow * corner[2], grow * corner[3], 0xffffff,
               Material::concrete);
      block.buildings = {quad};
      const Scene scene = make_scene({moved(block, {where, 0})});
      const BlockFrame& frame = scene.blocks[0];
      const culling::View view =
          look_in(frame, {0.013, -distance, 0.8 * static_cast<double>(grow)}, {0.01, 1, 0.003}, 60, kAspect);
      Renderer renderer(scene, simple_plants(), {.samples = 1});
      DrawOptions options;
      options.layers.sky = false;
      const VisibleSets sets = visible(scene, view, Structure::none);
      options.layers.buildings = false;
      const Picture without = take_picture(renderer, kSize, scene, sets, view, options);
      options.layers.buildings = true;
      const Picture with = take_picture(renderer, kSize, scene, sets, view, options);

      std::array<Vec2d, 4> p;
      for (std::size_t i = 0; i < 4; ++i) p[i] = project(view, kSize, frame.to_local(Vec3d(grow * corner[i])));
      constexpr double kMost = 0.1;  // px [numerics 7.1]
      int wrong = 0, covered = 0;
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          double inside = 1e9;
          for (std::size_t i = 0; i < 4; ++i) {
            inside = std::min(inside, -side_of(p[i], p[(i + 1) % 4], {x + 0.5, y + 0.5}));
          }
          const bool drawn = with.at(x, y) != without.at(x, y);
          covered += drawn ? 1 : 0;
          if (inside > kMost) wrong += drawn ? 0 : 1;
          if (inside < -kMost) wrong += drawn ? 1 : 0;
        }
      }
      CHECK(covered > 1000);
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("the picture does not depend on where the scene lies") {
  const gl::HeadlessContext context;
  HandBlock block;
  block.buildings = {make_box({0, 80, 0}, {20, 20, 40}, 0xb0a080, Material::wall),
                     make_box({-40, 120, 0}, {30, 20, 25}, 0xa05040, Material::wall)};
  block.surfaces = {make_level({0, 100, 0.05F}, {400, 400}, 0x5c8a3a, Material::grass),
                    make_level({25, 100, 0.10F}, {14, 380}, 0x555557, Material::junction)};
  TreeInstance tree;
  tree.position = {12, 40, 0};
  tree.yaw = 1;
  block.trees = {tree};
  const Scene here = make_scene({moved(block, {0, 0})}), there = make_scene({moved(block, {4.6e6, 0})});
  const auto picture = [](const Scene& scene) {
    const culling::View view = look_in(scene.blocks[0], {3, 0, 6}, {0, 1, -0.05}, 60, kAspect);
    VisibleSets sets = visible(scene, view, Structure::bqr);
    CarState car;
    car.position = scene.blocks[0].to_local({18, 30, 0.1});
    car.forward = scene.blocks[0].axes[1];
    sets.cars = {car};
    DrawOptions options;
    options.sun = scene.blocks[0].axes * Vec3d(0.45, -0.55, 0.7);
    Renderer renderer(scene, simple_plants(), {.samples = 1});
    return take_picture(renderer, kSize, scene, sets, view, options);
  };
  constexpr int kRounding = 12;   // of 255: noise under a texel's edge
  constexpr int kFewPixels = 80;  // of 76800: pixel centres that an edge grazes
  CHECK(different_pixels(picture(here), picture(there), kRounding) < kFewPixels);
}

TEST_CASE("surfaces at the tabulated gaps keep their order") {
  const gl::HeadlessContext context;
  struct Row {
    double distance, gap;  // metres [numerics 7.2: 15 um, 0.12 mm, 1.7 mm], twice
  };
  for (const Row& row : {Row{100, 30e-6}, Row{1000, 0.24e-3}, Row{10000, 3.4e-3}}) {
    for (const bool front_first : {true, false}) {
      INFO(row.distance << " m, front first: " << front_first);
      const auto half = static_cast<float>(0.4 * row.distance);
      const auto square = [&](double y, std::uint32_t rgb) {
        HandMesh mesh;
        const auto at = static_cast<float>(y);
        add_quad(mesh, {-half, at, -half}, {half, at, -half}, {half, at, half}, {-half, at, half}, rgb,
                 Material::concrete);
        return mesh;
      };
      HandBlock block;
      block.buildings = {square(0, 0xc01010), square(row.gap, 0x1010c0)};
      if (!front_first) std::swap(block.buildings[0], block.buildings[1]);
      const Scene scene = make_scene({block});
      const culling::View view = look_in(scene.blocks[0], {0, -row.distance, 0}, {0, 1, 0}, 40, kAspect);
      Renderer renderer(scene, simple_plants(), {.samples = 1});
      DrawOptions options;
      options.layers.fog = false;
      const Picture picture =
          take_picture(renderer, kSize, scene, visible(scene, view, Structure::none), view, options);
      int red = 0, blue = 0;
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          red += reddish(picture.at(x, y)) ? 1 : 0;
          blue +=
              picture.at(x, y)[2] > 2 * picture.at(x, y)[0] && picture.at(x, y)[2] > 2 * picture.at(x, y)[1] ? 1 : 0;
        }
      }
      CHECK(red > 50000);
      CHECK(blue == 0);
    }
  }
}

}  // namespace manzana::draw
