#include "scenegraph/draw/frame_data.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

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
      CHECK(clip.w == Approx(1.0 + i));
    }
  }
}

TEST_CASE("a host's matrices of any scale see the same and w is metres along the view") {
  const Mat4d look = glm::lookAt(Vec3d(5, 6, 7), Vec3d(0, 0, 2), Vec3d(0, 0, 1));
  const Mat4d perspective = glm::perspective(0.9, 1.5, 0.2, 900.0);
  const Camera once = camera_of(perspective, look, culling::ClipDepth::minus_one_to_one, 600);
  const Camera scaled = camera_of(7.0 * perspective, look, culling::ClipDepth::minus_one_to_one, 600);
  const glm::dvec4 middle = once.view_projection * glm::dvec4(Vec3d(0, 0, 2) - once.eye, 1);
  CHECK(middle.w == Approx(glm::length(Vec3d(5, 6, 5))));
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      CHECK(scaled.view_projection[column][row] == Approx(once.view_projection[column][row]).margin(1e-12));
}

TEST_CASE("of an orthographic view w is how far behind its eye is") {
  const Mat4d look = glm::lookAt(Vec3d(50, 60, 70), Vec3d(0, 0, 2), Vec3d(0, 0, 1));
  const Camera camera = camera_of(3.0 * glm::ortho(-40.0, 40.0, -30.0, 30.0, 1.0, 200.0), look,
                                  culling::ClipDepth::minus_one_to_one, 600);
  const Vec3d rel = Vec3d(0, 0, 2) - camera.eye;
  const glm::dvec4 clip = camera.view_projection * glm::dvec4(rel, 1);
  CHECK(clip.w == Approx(glm::length(rel)).epsilon(0.02));
  CHECK(clip.z / clip.w == Approx((200 - glm::length(Vec3d(50, 60, 68))) / 199));
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
