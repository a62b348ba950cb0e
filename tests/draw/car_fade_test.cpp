// Cars on the way from one level to the next.
#include <glad/gl.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "gl/context.h"
#include "scenegraph/draw/car_model.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"

namespace manzana::draw {

// The error that is tolerated chooses, so the car may stand still while one level gives way to the next.
TEST_CASE("between two levels of a car each sample shows one of them and the ground is darkened once") {
  const gl::HeadlessContext context;
  constexpr Size kSize{320, 240};
  HandBlock block;
  block.surfaces = {make_level({0, 100, 0.1F}, {400, 400}, 0x5a5a5c, Material::junction)};
  const Scene scene = make_scene({block});
  Renderer renderer(scene, simple_plants(), {.name = "low", .samples = 1, .tree_error_px = 2});
  const culling::View view = look_in(scene.blocks[0], {0, 0, 1.5}, {0, 1, 0}, 20, 4.0 / 3.0);
  VisibleSets sets = visible(scene, view, Structure::bqr);
  const Picture empty = take_picture(renderer, kSize, scene, sets, view);
  CarState car;
  car.position = scene.blocks[0].to_local({0.5, 12, 0.1});
  car.forward = glm::normalize(scene.blocks[0].axes[0] + 0.5 * scene.blocks[0].axes[1]);
  sets.cars = {car};
  const double radius_px = culling::projected_radius(kCarRadius, glm::distance(car.position, view.eye),
                                                     focal_px(camera_of(view), kSize.height));
  const auto drawn_at = [&](double radius) {
    DrawOptions options;
    options.tree_error_px = radius_px / radius;
    return take_picture(renderer, kSize, scene, sets, view, options);
  };
  for (std::size_t level = 0; level + 1 < kCarLevels; ++level) {
    const double high = kCarMinRadiusPx[level], low = high / kCarFade;
    const Picture finer = drawn_at(high * 1.001), coarser = drawn_at(low * 0.999);
    for (const double share : {0.25, 0.5, 0.75}) {
      INFO("level " << level << ", share " << share);
      const Picture between = drawn_at(low + share * (high - low));
      int of_finer = 0, of_coarser = 0, of_none = 0;
      std::array<double, 3> covered{};
      for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
          const auto a = finer.at(x, y), b = coarser.at(x, y), c = between.at(x, y), none = empty.at(x, y);
          covered[0] += a != none, covered[1] += b != none, covered[2] += c != none;
          if (a == b)
            of_none += c != a;
          else if (c == a)
            ++of_finer;
          else if (c == b)
            ++of_coarser;
          else
            ++of_none;
        }
      CHECK(of_none == 0);
      CHECK(of_finer + of_coarser > 100);
      CHECK(std::abs(of_finer - share * (of_finer + of_coarser)) < 0.08 * (of_finer + of_coarser));
      CHECK(std::abs(covered[2] - (share * covered[0] + (1 - share) * covered[1])) < 0.02 * covered[0]);
    }
  }
}

}  // namespace manzana::draw
