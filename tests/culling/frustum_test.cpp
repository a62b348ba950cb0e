// Planes against the same planes in fifty digits [numerics 1].
#include "culling/frustum.h"

#include <catch2/catch.hpp>
#include <cfloat>

#include "culling/baselines/exact_planes.h"
#include "tests/culling/polytope.h"

namespace manzana::culling::test {
namespace {

constexpr double kUnit = DBL_EPSILON / 2;

TEST_CASE("planes are exact to four units") {
  Random random(11);
  double worst = 0, worst_offset = 0;
  for (int i = 0; i < 3000; ++i) {
    const View view = random_view(random, eyes()[random.below(eyes().size())]);
    const FrustumD frustum = make_frustum(view);
    const BigPlanes exact = exact_planes(view);
    REQUIRE(frustum.count == (missing(exact[kFar]) ? 5 : 6));
    for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
      const auto& [normal, offset] = frustum.planes[k];
      worst = std::max(worst, static_cast<double>(length(cross(big(normal), exact[k].normal))));
      if (offset != 0) worst_offset = std::max(worst_offset, static_cast<double>(abs(offset / exact[k].offset - 1)));
    }
  }
  INFO("seed 11, worst " << worst / kUnit << " and " << worst_offset / kUnit << " units");
  CHECK(worst <= 4 * kUnit);
  CHECK(worst_offset <= 4 * kUnit);
}

TEST_CASE("look makes an orthonormal basis, whatever is up") {
  Random random(12);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = random.scale(1e-200, 1e200);
    const Vec3d forward = random.direction() * size;
    const Vec3d nearly = forward + random.direction() * (size * random.scale(1e-12, 1));
    const Vec3d up = i % 3 == 0 ? forward : i % 3 == 1 ? nearly : random.direction();
    const View v = look(Vec3d(0), forward, up, 1, 1);
    for (const Vec3d& a : {v.right, v.up, v.forward})
      worst = std::max(worst, static_cast<double>(abs(length(big(a)) - 1)));
    for (const Big& d :
         {dot(big(v.right), big(v.up)), dot(big(v.right), big(v.forward)), dot(big(v.up), big(v.forward))})
      worst = std::max(worst, static_cast<double>(abs(d)));
    if (i % 3 == 2) CHECK(glm::dot(v.up, up) > 0);
    CHECK(glm::dot(v.forward, forward) > 0);
    CHECK(glm::length(v.right - glm::cross(v.forward, v.up)) < 1e-15);
  }
  INFO("seed 12, worst " << worst / kUnit << " units");
  CHECK(worst <= 6 * kUnit);
}

TEST_CASE("look: angles become tangents") {
  for (const double degrees : {1e-3, 60.0, 179.0}) {
    const View v = look(Vec3d(0), {0, 1, 0}, {0, 0, 1}, glm::radians(degrees), 2);
    CHECK(v.tan_top == Approx(std::tan(glm::radians(degrees) / 2)).epsilon(1e-15));
    CHECK(v.tan_right == 2 * v.tan_top);
    CHECK(v.tan_left == -v.tan_right);
    CHECK(v.right == Vec3d(1, 0, 0));
  }
}

TEST_CASE("an infinite view has no far plane, a side without a normal never culls") {
  View view = look(Vec3d(0), {0, 1, 0}, {0, 0, 1}, 1, 1);
  CHECK(make_frustum(view).count == 5);
  view.far_m = 100;
  CHECK(make_frustum(view).count == 6);
  view.tan_right = std::numeric_limits<double>::infinity();
  const FrustumD frustum = make_frustum(view);
  CHECK(frustum.planes[kRight].normal == Vec3d(0));
  CHECK(frustum.planes[kRight].offset == kNoPlane.offset);
  view.tan_left = 1e200;  // a square would overflow
  CHECK(make_frustum(view).planes[kLeft].normal.y == -1);
}

/// Corners from planes by Cramer's rule, and the distances of the corners to the planes.
TEST_CASE("planes, corners, planes") {
  Random random(13);
  for (int i = 0; i < 500; ++i) {
    View view = random_view(random, Vec3d(0));
    view.far_m = view.near_m * random.scale(2, 1e7);
    const FrustumD f = make_frustum(view);
    for (const PlaneIndex depth : {kNear, kFar})
      for (const PlaneIndex x : {kLeft, kRight})
        for (const PlaneIndex y : {kBottom, kTop}) {
          const PlaneD &a = f.planes[x], &b = f.planes[y], &c = f.planes[depth];
          const Vec3l bc = glm::cross(Vec3l(b.normal), Vec3l(c.normal));
          const Vec3l ca = glm::cross(Vec3l(c.normal), Vec3l(a.normal));
          const Vec3l ab = glm::cross(Vec3l(a.normal), Vec3l(b.normal));
          const Real volume = glm::dot(Vec3l(a.normal), bc);
          const Vec3l corner = -(static_cast<Real>(a.offset) * bc + static_cast<Real>(b.offset) * ca +
                                 static_cast<Real>(c.offset) * ab) /
                               volume;
          const Real z = static_cast<Real>(depth == kNear ? view.near_m : view.far_m);
          const Vec3l wanted = z * (Vec3l(view.forward) +
                                    static_cast<Real>(x == kLeft ? view.tan_left : view.tan_right) * Vec3l(view.right) +
                                    static_cast<Real>(y == kBottom ? view.tan_bottom : view.tan_top) * Vec3l(view.up));
          // Units of double, enlarged by how flat the three planes meet.
          const Real tolerance = 16 * static_cast<Real>(kUnit) * glm::length(wanted) / std::abs(volume);
          REQUIRE(glm::length(corner - wanted) <= tolerance);
        }
  }
}

TEST_CASE("projected radius") {
  CHECK(projected_radius(50, 60, 935.3) == Approx(1410).epsilon(1e-3));  // [numerics 2.7]
  CHECK(std::isinf(projected_radius(5, 5, 900)));
  CHECK(std::isinf(projected_radius(5, 1, 900)));
  CHECK(projected_radius(0, 1, 900) == 0);
  CHECK(projected_radius_orthographic(5, 1080, 540) == 10);
}

}  // namespace
}  // namespace manzana::culling::test
