// Pictures that buildings of CityJSON wear, from the file to a host's pixels: where each part of a picture comes to
// lie, beyond its edges too, and from a baked city as from its source.
#include <catch2/catch.hpp>

#include "scenegraph/import/baked_city.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/worn_house.h"

using namespace manzana;
using made::Json;
using namespace worn_house;

namespace {

const LoadOptions kNoTrees{.cars = 0, .trees = false};

enum class Seen { red, green, blue, white, yellow, other };

/// By the light of a southern wall in the sun.
Seen seen_in(const Rgba& pixel) {
  const auto [r, g, b, a] = pixel.c;
  const auto over = [](int x, int y) { return 2 * x > 3 * y + 20; };
  if (a < 255) return Seen::other;
  if (over(r, g) && over(r, b)) return Seen::red;
  if (over(g, r) && over(g, b)) return Seen::green;
  if (over(b, r) && over(b, g)) return Seen::blue;
  if (over(r, b) && over(g, b)) return Seen::yellow;
  return std::min({r, g, b}) > 200 ? Seen::white : Seen::other;
}

Seen quarter(double u, double v) {
  return v < 0.5 ? (u < 0.5 ? Seen::red : Seen::green) : u < 0.5 ? Seen::blue : Seen::white;
}

/// Of the wall's place: `along` from the west and up, 0 to 1.
Rgba pixel_at(const std::vector<Rgba>& picture, const HostCamera& camera, const Scene& scene, const Vec2d& along) {
  const Vec3d &low = scene.bounds.min, &high = scene.bounds.max;
  const glm::dvec4 p(glm::mix(low.x, high.x, along.x), low.y, glm::mix(low.z, high.z, along.y), 1);
  const glm::dvec4 clip = camera.projection * camera.view * p;
  const Vec2d at = (Vec2d(clip) / clip.w * 0.5 + 0.5) * Vec2d(kWidth, kHeight);
  return picture.at(static_cast<std::size_t>(at.y) * kWidth + static_cast<std::size_t>(at.x));
}

/// What the wall shows at the middles of the quarters of 3 x 1 pictures.
std::vector<Seen> quarters_seen(const std::shared_ptr<const Model>& model) {
  const HostWindow window(kWidth, kHeight);
  const HostCamera camera = before_wall(model->scene());
  View view({}, {.quality = "balanced"});
  view.show(model);
  const auto shown = picture(view, window, camera);
  CHECK(view.complete());
  view.release();
  std::vector<Seen> seen;
  for (const double up : {0.25, 0.75})
    for (int i = 0; i < 6; ++i) seen.push_back(seen_in(pixel_at(shown, camera, model->scene(), {(i + 0.5) / 6, up})));
  return seen;
}

}  // namespace

TEST_CASE("view: each part of a wall's picture lies where the file says beyond its edges too") {
  const gl::HeadlessContext context;
  const TemporaryFolder folder;
  write_quarters(folder.path() / "quarters.png");
  constexpr Seen R = Seen::red, G = Seen::green, B = Seen::blue, W = Seen::white, Y = Seen::yellow, O = Seen::other;
  const std::vector<std::pair<std::string, std::vector<Seen>>> cases{
      {"wrap", {R, G, R, G, R, G, B, W, B, W, B, W}},  {"mirror", {G, R, R, G, G, R, W, B, B, W, W, B}},
      {"clamp", {R, R, R, G, G, G, B, B, B, W, W, W}}, {"border", {Y, Y, R, G, Y, Y, Y, Y, B, W, Y, Y}},
      {"none", {O, O, R, G, O, O, O, O, B, W, O, O}},  {"", {R, G, R, G, R, G, B, W, B, W, B, W}}};
  for (const auto& [wrap, expected] : cases) {
    CAPTURE(wrap);
    const auto model = Model::load(written(folder.path(), house(wrap, {-1, 0}, {2, 1})).string(), kNoTrees);
    CHECK(quarters_seen(model) == expected);
  }
}

TEST_CASE("view: a picture lies as finely as the screen shows it and its seams are where they belong") {
  const gl::HeadlessContext context;
  const TemporaryFolder folder;
  write_quarters(folder.path() / "quarters.png");
  const auto model = Model::load(written(folder.path(), house("wrap", {0, 0}, {1, 1})).string(), kNoTrees);
  const HostWindow window(kWidth, kHeight);
  const HostCamera camera = before_wall(model->scene());
  View view;
  view.show(model);
  const auto shown = picture(view, window, camera);
  int wrong = 0;
  for (int x = 1; x < 60; ++x)
    for (int y = 1; y < 20; ++y) {
      const Vec2d at(x / 60.0, y / 20.0);
      if (std::min(std::abs(at.x - 0.5), std::abs(at.y - 0.5)) < 0.04) continue;
      wrong += seen_in(pixel_at(shown, camera, model->scene(), at)) != quarter(at.x, at.y) ? 1 : 0;
    }
  CHECK(wrong == 0);
  view.colour_by([](const Feature&) { return View::Colour(0x00f000); });  // a host's colour covers it
  const auto painted = picture(view, window, camera);
  CHECK(seen_in(pixel_at(painted, camera, model->scene(), {0.2, 0.2})) == Seen::green);
  view.colour_by({});
  CHECK(picture(view, window, camera) == shown);
  view.release();
}

TEST_CASE("view: a wall has its mean colour until a thread of the host's has made its picture and again after a loss") {
  const gl::HeadlessContext context;
  const TemporaryFolder folder;
  write_quarters(folder.path() / "quarters.png");
  const auto model = Model::load(written(folder.path(), house("wrap", {0, 0}, {1, 1})).string(), kNoTrees);
  const HostWindow window(kWidth, kHeight);
  const HostCamera camera = before_wall(model->scene());
  std::vector<std::function<void()>> tasks;
  int repaints = 0;
  View view({.request_repaint = [&] { ++repaints; },
             .run = [&](std::function<void()> task) { tasks.push_back(std::move(task)); }});
  view.show(model);
  const std::array cameras{camera};
  const auto shown = [&] {
    window.bind();
    while (!view.update(cameras, 0).shown) view.render(0);
    window.clear(0, 0, 0, 0);
    view.render(0);
    return seen_in(pixel_at(window.pixels(), camera, model->scene(), {0.25, 0.25}));
  };
  for (int life = 0; life < 2; ++life) {
    CHECK(shown() == Seen::other);
    CHECK(!view.complete());
    CHECK(view.update(cameras, 0).pictures_left == 1);
    REQUIRE(tasks.size() == 1);
    repaints = 0;
    tasks.back()();
    tasks.clear();
    CHECK(repaints == 1);
    CHECK(shown() == Seen::red);
    CHECK(view.complete());
    CHECK(view.update(cameras, 0).pictures_left == 0);
    view.release();
  }
}

TEST_CASE("view: a baked city has its pictures in its own file and several cities keep theirs apart") {
  const gl::HeadlessContext context;
  const TemporaryFolder folder;
  const auto baked = folder.path() / "house.manzana";
  write_quarters(folder.path() / "quarters.png");
  const auto file = written(folder.path(), house("wrap", {-1, 0}, {2, 1}));
  const auto source = Model::load(file.string(), kNoTrees);
  const std::vector<Seen> expected = quarters_seen(source);
  Imported twice = import_city(file.string(), {.cars = 0}, {});
  write_baked(baked, twice);
  std::filesystem::remove(folder.path() / "quarters.png");
  CHECK(quarters_seen(Model::load(baked.string(), kNoTrees)) == expected);
  // a house that wears nothing any more, and one from the baked file, in one place
  CHECK(quarters_seen(source) == std::vector<Seen>(12, Seen::other));
  std::vector<Imported> both;
  both.push_back(import_city(baked.string(), {}, {}));
  both.push_back(import_city(baked.string(), {}, {}));
  const Imported merged = merge(std::move(both));
  CHECK(merged.scene.pictures.encoded.size() == 2);
  CHECK(merged.scene.pictures.textures.at(1).picture == 1);
  const auto& worn = merged.scene.buildings.mesh.textures;
  CHECK(std::ranges::count(worn, 1U) == 4);
  CHECK(std::ranges::count(worn, 2U) == 4);
}
