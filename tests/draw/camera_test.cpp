#include "scenegraph/draw/frame_data.h"

#include <catch2/catch.hpp>

#include "tests/draw/picture.h"

namespace manzana::draw {

TEST_CASE("the matrix puts points where the projection by hand does, also off axis and mirrored") {
  constexpr Size kSize{1920, 1080};
  culling::View view = culling::look({12, -7, 3}, {0.3, 1, -0.2}, {0, 0, 1}, 1.0, 16.0 / 9.0);
  for (const int kind : {0, 1, 2}) {
    if (kind == 1) {
      view.tan_left = -0.2;
      view.tan_top = 0.9;
    }
    if (kind == 2) view.right = -view.right;
    const Mat4 matrix(camera_of(view).view_projection);
    for (int i = 0; i < 50; ++i) {
      const Vec3d rel = view.forward * (1.0 + i) + view.right * (0.1 * (i % 7)) + view.up * (0.07 * (i % 5));
      const Vec4 clip = matrix * Vec4(Vec3(rel), 1);
      const Vec2d exact = project(view, kSize, view.eye + rel);
      CHECK((clip.x / clip.w + 1) / 2 * kSize.width == Approx(exact.x).margin(0.01));
      CHECK((1 - clip.y / clip.w) / 2 * kSize.height == Approx(exact.y).margin(0.01));
      CHECK(clip.z / clip.w == Approx(view.near_m / (1.0 + i)).epsilon(1e-5));
    }
  }
}

TEST_CASE("a block is placed relative to the eye without loss far from the origin") {
  BlockFrame block;
  block.origin = {4.6e6, -3.2e6, 17};
  const Vec3d eye = block.origin + Vec3d(0.125, -0.25, 2);
  const Vec3 placed_at = placed(relative_to(eye, block), {1, 2, 3});
  CHECK(placed_at.x == 0.875F);
  CHECK(placed_at.y == 2.25F);
  CHECK(placed_at.z == 1.0F);
}

}  // namespace manzana::draw
