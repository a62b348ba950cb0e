// A picture from the air in a host's window: it lies on the ground, where it belongs, and on nothing else.
#include <catch2/catch.hpp>

#include "foliage/import/load_plant.h"
#include "tests/support/quartered_photo.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/host.h"

using namespace manzana;

namespace {

/// Where the ray through a pixel's middle meets the plane z = 0.
Vec3d level_place(const HostCamera& camera, int x, int y) {
  const Vec2d ndc = 2.0 * Vec2d((x + 0.5) / camera.viewport.width, (y + 0.5) / camera.viewport.height) - 1.0;
  const auto at = [&](double depth) {
    const glm::dvec4 p = glm::inverse(camera.projection * camera.view) * glm::dvec4(ndc, depth, 1);
    return Vec3d(p) / p.w;
  };
  const Vec3d near = at(-1), far = at(0.5);
  return near + (far - near) * (near.z / (near.z - far.z));
}

}  // namespace

TEST_CASE("view: an orthophoto lies over the ground of a host's city and on nothing else") {
  constexpr int kWidth = 320, kHeight = 200;
  const TemporaryFolder folder;
  const auto photo = folder.path() / "air.tif";
  support::write_quartered(photo, town()->frame());
  const auto model =
      Model::load("builtin:town", {.cars = 100, .orthophoto = photo, .plant_cache = foliage::default_cache_folder()});
  const gl::HeadlessContext context;
  const HostWindow window(kWidth, kHeight);
  const HostCamera camera = looking({15, -160, 260}, {0, 0, 0}, kWidth, kHeight);
  View with, without;
  with.show(model);
  without.show(town());
  for (View* view : {&with, &without}) view->drawing().layers.trees = view->drawing().layers.cars = false;
  const auto plain = picture(without, window, camera), laid = picture(with, window, camera);
  std::vector<FeatureId> ids(static_cast<std::size_t>(kWidth * kHeight));
  with.pick(0, {0, 0, kWidth, kHeight}, ids);
  int ground = 0, right = 0, buildings = 0, same = 0;
  for (int y = 0; y < kHeight; y += 2)
    for (int x = 0; x < kWidth; x += 2) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      if (ids[i] != 0 && model->feature(ids[i]).kind == kBuilding) {
        ++buildings;
        same += laid[i] == plain[i] ? 1 : 0;
        continue;
      }
      const Vec3d at = level_place(camera, x, y);  // of streets and parks, and of what lies bare between them
      if (support::near_a_seam(at)) continue;
      ++ground;
      right += support::is_quarter(laid[i].c[0], laid[i].c[1], laid[i].c[2], at) ? 1 : 0;
    }
  CHECK(ground > 2000);
  CHECK(right > 0.97 * ground);
  CHECK(buildings > 1000);
  CHECK(same > 0.97 * buildings);
  with.release();
  without.release();
}
