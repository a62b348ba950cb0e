// The sun's light and the sky's, by where the sun stands.
#include <catch2/catch.hpp>

#include "scenegraph/draw/frame_data.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {
namespace {

FrameData lit_from(const Vec3d& sun) {
  DrawOptions options;
  options.sun = sun;
  return make_frame(LocalFrame{}, Camera{}, options, BlockFrame{});
}

}  // namespace

TEST_CASE("the sun's direction is a compass's") {
  CHECK(glm::length(sun_direction(0, 0) - Vec3d(0, 1, 0)) < 1e-12);
  CHECK(glm::length(sun_direction(90, 0) - Vec3d(1, 0, 0)) < 1e-12);
  CHECK(glm::length(sun_direction(123, 90) - Vec3d(0, 0, 1)) < 1e-12);
}

TEST_CASE("a lower sun is redder and weaker and never less than nothing") {
  Vec4 before = lit_from(sun_direction(0, 90)).sun_light;
  for (int height = 85; height >= -10; height -= 5) {
    const FrameData frame = lit_from(sun_direction(200, height));
    const Vec4 light = frame.sun_light;
    CAPTURE(height);
    for (int c = 0; c < 3; ++c) {
      CHECK((height < 0 ? light[c] <= before[c] : light[c] < before[c]));
      CHECK(light[c] > 0);
      CHECK(frame.zenith[c] > 0);
    }
    CHECK(light.x / light.z >= before.x / before.z * 0.9999F);
    before = light;
  }
}

TEST_CASE("under the sun that is the default lights are what they are meant to be") {
  const FrameData frame = lit_from(DrawOptions{}.sun);
  CHECK(frame.sun_light.x == Approx(1.75).epsilon(0.002));
  CHECK(frame.sun_light.z == Approx(1.38).epsilon(0.002));
  CHECK(frame.zenith.z == Approx(0.72).epsilon(0.005));
}

}  // namespace manzana::draw
