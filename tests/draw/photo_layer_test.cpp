// The ground's photo in pictures: where its squares come to lie, how bright they are, and what is held of it.
#include "scenegraph/draw/photo_layer.h"

#include <catch2/catch.hpp>

#include "foliage/leaf_image.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/draw/hand_scene.h"
#include "tests/draw/picture.h"

namespace manzana::draw {
namespace {

constexpr Size kSize{320, 240};
constexpr double kAspect = 4.0 / 3.0;

/// Squares of a made-up photo, by column and row.
template <class Colour>
GroundPhoto make_photo(const Vec2d& origin, double step, std::uint32_t side, Colour&& colour) {
  GroundPhoto photo{origin, step, {{side, side, {}}}};
  for (std::uint32_t r = 0; r < side; ++r)
    for (std::uint32_t c = 0; c < side; ++c) photo.levels[0].texels.push_back(colour(c, r));
  add_levels(photo.levels);
  return photo;
}

Scene lawn() {
  HandBlock block;
  block.surfaces = {make_level({0, 60, 0}, {600, 60}, 0x408040, Material::grass)};  // beside it the Earth's own ground
  return make_scene({block});
}

culling::View from_above(const Scene& scene, double height) {
  return look_in(scene.blocks[0], {3, 20, height}, {0.001, 0.15, -1}, 50, kAspect);
}

DrawOptions plain() {
  DrawOptions options;
  options.layers.fog = false;
  return options;
}

/// As light.glsl has it: level ground under our sun, on the film.
int on_film(std::uint8_t srgb, double open, std::size_t channel) {
  constexpr std::array<double, 3> kSun{1.75, 1.62, 1.38}, kSky{0.50, 0.60, 0.76};
  const double up = 0.70 / glm::length(Vec3d(0.45, -0.55, 0.70));
  const double light = kSky[channel] * open + kSun[channel] * up;
  const double x = 0.62 * light * static_cast<double>(foliage::linear_of_srgb(srgb));
  const double y = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  return foliage::srgb_of_linear(static_cast<float>(std::clamp(y, 0.0, 1.0)));
}

}  // namespace

TEST_CASE("photo: squares lie where they belong on surfaces and on the Earth's ground and have their colours") {
  const gl::HeadlessContext context;
  gl::ErrorLog errors;
  Scene scene = lawn();
  const auto colour = [](std::uint32_t c, std::uint32_t r) {
    const auto steps = [](std::uint32_t i) { return static_cast<std::uint8_t>(i % 4 == 3 ? 100 : 60 + 40 * (i % 4)); };
    return GroundPhoto::Texel{steps(c), steps(r), static_cast<std::uint8_t>(c / 100 * 20), 255};
  };
  scene.photo = make_photo({-511.3, -503.9}, 2, 1000, colour);
  Renderer renderer(scene, simple_plants(), {.samples = 1});
  const culling::View view = from_above(scene, 60);
  const Picture picture = take_picture(renderer, kSize, scene, visible(scene, view, Structure::bqr), view, plain());
  int looked = 0, worst = 0;
  for (std::uint32_t r = 240; r < 320; ++r)
    for (std::uint32_t c = 230; c < 290; ++c) {
      const Vec2d plan = scene.photo.origin + scene.photo.step * (Vec2d(c, r) + 0.5);
      const Vec2d at = project(view, kSize, {plan.x, plan.y, scene.frame.ground_z(plan)});
      if (at.x < 1 || at.y < 1 || at.x > kSize.width - 1 || at.y > kSize.height - 1) continue;
      const auto seen = picture.at(static_cast<int>(at.x), static_cast<int>(at.y));
      const auto expected = colour(c, r);
      for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(seen[i] - on_film(expected[i], 0.9, i)));
      ++looked;
    }
  CHECK(looked > 800);
  CHECK(worst <= 8);  // 8 pixels a square: the middle of one is up to 0.7 pixels away
}

TEST_CASE("photo: from far a chequered ground is half as bright in light and beyond its edge there is none") {
  const gl::HeadlessContext context;
  Scene scene = lawn();
  scene.photo = make_photo({-800, -800}, 1, 1600, [](std::uint32_t c, std::uint32_t r) {
    const auto v = static_cast<std::uint8_t>((c + r) % 2 == 0 ? 0 : 200);
    return GroundPhoto::Texel{v, v, v, 255};
  });
  Renderer renderer(scene, simple_plants(), {.samples = 1});
  const culling::View view = from_above(scene, 1500);
  const Picture picture = take_picture(renderer, kSize, scene, visible(scene, view, Structure::bqr), view, plain());
  const std::uint8_t half = foliage::srgb_of_linear(foliage::linear_of_srgb(200) / 2);
  for (std::size_t i = 0; i < 3; ++i) CHECK(picture.at(150, 160)[i] == Approx(on_film(half, 0.9, i)).margin(3));
  scene.photo = {};
  Renderer bare(scene, simple_plants(), {.samples = 1});
  const Picture without = take_picture(bare, kSize, scene, visible(scene, view, Structure::bqr), view, plain());
  CHECK(without.at(2, 120) == picture.at(2, 120));
  CHECK(without.at(150, 160) != picture.at(150, 160));
}

TEST_CASE("photo: windows come by strips and move and end as if all had come at once") {
  const gl::HeadlessContext context;
  Scene scene = lawn();
  scene.photo = make_photo({-1500, -1500}, 0.5, 6000, [](std::uint32_t c, std::uint32_t r) {
    return GroundPhoto::Texel{static_cast<std::uint8_t>(c * 7), static_cast<std::uint8_t>(r * 5),
                              static_cast<std::uint8_t>((c ^ r) / 16), 255};
  });
  Renderer slow(scene, simple_plants(), {.samples = 1});
  DrawOptions little = plain();
  little.upload_bytes = 300'000;
  for (const Vec2d& eye : {Vec2d(0, 0), Vec2d(150, -90), Vec2d(1400, 1400)}) {
    const culling::View view = look_in(scene.blocks[0], {eye, 4}, {0.3, 1, -0.4}, 60, kAspect);
    const VisibleSets sets = visible(scene, view, Structure::bqr);
    slow.resize(kSize);
    int frames = 0;
    while (slow.draw(scene, sets, view, little).bytes_to_bring > 0) REQUIRE(++frames < 200);
    CHECK(frames > 3);
    Renderer fast(scene, simple_plants(), {.samples = 1});
    const Picture expected = take_picture(fast, kSize, scene, sets, view, plain());
    CHECK(different_pixels(take_picture(slow, kSize, scene, sets, view, plain()), expected, 0) == 0);
  }
}

TEST_CASE("photo: what is held keeps to its share of the device's bytes and the picture is coarser then") {
  const gl::HeadlessContext context;
  const GroundPhoto photo = make_photo({0, 0}, 0.5, 3000, [](auto, auto) { return GroundPhoto::Texel{9, 9, 9, 255}; });
  const PhotoPlan all = plan_photo(photo, 600, 0), some = plan_photo(photo, 600, 2'000'000),
                  none = plan_photo(photo, 600, 1);
  CHECK(all == PhotoPlan{0, 2048, 3});
  CHECK(some.windows * static_cast<std::size_t>(some.side * some.side) * 4 <= 2'000'000);
  CHECK(some.first == 0);
  CHECK(none == PhotoPlan{3, 256, 0});
  CHECK(PhotoLayerGpu(photo, none).device_bytes() < 1'500'000);
}

}  // namespace manzana::draw
