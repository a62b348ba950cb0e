// The C header does what the C++ one does, and shows nothing else.
#include <catch2/catch.hpp>
#include <cstring>

#include "manzana/manzana.h"
#include "tests/support/program.h"
#include "tests/view/host.h"

using namespace manzana;

extern "C" manzana_camera c_camera(int width, int height);

namespace {

constexpr int kWidth = 200, kHeight = 120;

manzana_camera as_c(const HostCamera& camera) {
  manzana_camera c = c_camera(camera.viewport.width, camera.viewport.height);
  std::memcpy(c.projection, &camera.projection[0].x, sizeof c.projection);
  std::memcpy(c.view, &camera.view[0].x, sizeof c.view);
  return c;
}

manzana_model* load(const char* city, manzana_error* error) {
  manzana_load_options options = manzana_load_defaults();
  options.cars = 0;
  options.trees = 0;
  return manzana_model_load(city, &options, nullptr, nullptr, error);
}

}  // namespace

TEST_CASE("c: a picture and what is picked in it") {
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  manzana_error error{};
  manzana_model* city = load("builtin:town", &error);
  REQUIRE(city != nullptr);
  int repaints = 0;
  const manzana_host host{&repaints, nullptr, [](void* n) { ++*static_cast<int*>(n); }, nullptr};
  manzana_view* view = manzana_view_create(&host, nullptr);
  manzana_view_show(view, city);
  const manzana_camera camera = as_c(street_camera(kWidth, kHeight));
  manzana_update update{};
  manzana_seen seen{};
  for (int frame = 0; frame < 100 && update.shown == 0; ++frame) {
    window.bind();
    REQUIRE(manzana_view_render(view, 0, &error) == 1);
    manzana_view_update(view, &camera, 1, 0, &update, &seen);
  }
  REQUIRE(update.shown == 1);
  CHECK(repaints > 0);
  CHECK(seen.buildings > 50);
  window.clear(0, 0, 0, 0);
  REQUIRE(manzana_view_render(view, 0, &error) == 1);
  const auto pixels = window.pixels();
  std::vector<std::uint32_t> ids(kWidth * kHeight);
  REQUIRE(manzana_view_pick(view, 0, 0, 0, kWidth, kHeight, ids.data(), &error) == 1);
  std::size_t same = 0, wrong = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    same += (ids[i] != 0) == (pixels[i].c[3] > 0) ? 1 : 0;
    manzana_feature feature{};
    if (ids[i] != 0 && manzana_model_feature(city, ids[i], &feature) != 1) ++wrong;
  }
  CHECK(static_cast<double>(same) > 0.97 * static_cast<double>(ids.size()));
  CHECK(wrong == 0);
  manzana_drawing drawing = manzana_view_drawing(view);
  CHECK(drawing.sky == 0);
  drawing.buildings = 0;
  manzana_view_set_drawing(view, &drawing);
  window.clear(0, 0, 0, 0);
  REQUIRE(manzana_view_render(view, 0, &error) == 1);
  CHECK(share_different(window.pixels(), pixels, 8) > 0.1);
  CHECK(manzana_view_pick(view, 0, 0, 0, 0, 5, ids.data(), &error) == 0);
  CHECK(std::string(error.text) == "a rectangle without pixels");
  manzana_view_release(view);
  manzana_view_free(view);
  manzana_model_free(city);
}

TEST_CASE("c: places lead there and back and errors are a line") {
  manzana_error error{};
  CHECK(load("nowhere.osm", &error) == nullptr);
  CHECK(std::string(error.text).starts_with("nowhere.osm: "));
  CHECK(load("nowhere.osm", nullptr) == nullptr);
  manzana_model* city = load("builtin:town", &error);
  REQUIRE(city != nullptr);
  const double local[3] = {120, -80, 15};
  double geo[3], back[3];
  manzana_model_to_geo(city, local, geo);
  REQUIRE(manzana_model_to_local(city, geo, back) == 1);
  for (int k = 0; k < 3; ++k) CHECK(back[k] == Approx(local[k]).margin(1e-6));
  const double no_place[3] = {91, 0, 0};
  CHECK(manzana_model_to_local(city, no_place, back) == 0);
  manzana_feature feature{};
  CHECK(manzana_model_feature(city, 0, &feature) == 0);
  CHECK(manzana_model_feature(city, manzana_model_features(city) + 1, &feature) == 0);
  CHECK(std::string(manzana_model_credits(city)).empty());
  manzana_model_free(city);
}

TEST_CASE("c: the library shows its own functions and nothing else") {
  const TemporaryFolder folder;
  const Ended ended = run_program("/usr/bin/nm", folder.path(), {"-D", "--defined-only", MANZANA_LIBRARY});
  REQUIRE(ended.code == 0);
  std::istringstream lines(ended.out);
  int functions = 0;
  for (std::string address, kind, name; lines >> address >> kind >> name; ++functions) {
    INFO(name);
    CHECK(name.starts_with("manzana_"));
  }
  CHECK(functions == 24);
}
