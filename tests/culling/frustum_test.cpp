// Planes against the same planes in fifty digits [numerics 1].
#include "culling/frustum.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cfloat>

#include "tests/culling/polytope.h"

namespace manzana::culling::test {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;
using Vec3b = std::array<Big, 3>;
constexpr double kUnit = DBL_EPSILON / 2;

Vec3b big(const Vec3d& v) { return {Big(v.x), Big(v.y), Big(v.z)}; }
Vec3b combine(const Vec3b& a, const Big& s, const Vec3b& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
Big dot(const Vec3b& a, const Vec3b& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Big length(const Vec3b& a) { return sqrt(dot(a, a)); }

struct BigPlane {
  Vec3b normal;
  Big offset;
};

/// sign * (side - tangent * forward), of length 1.
BigPlane side(const Vec3d& across, double tangent, const Vec3d& forward, int sign) {
  Vec3b n = combine(big(across), -Big(tangent), big(forward));
  const Big scale = sign / sqrt(1 + Big(tangent) * tangent);
  for (Big& x : n) x *= scale;
  return {n, 0};
}

std::vector<BigPlane> big_planes(const View& v) {
  std::vector<BigPlane> planes{side(v.right, v.tan_left, v.forward, 1),
                               side(v.right, v.tan_right, v.forward, -1),
                               side(v.up, v.tan_bottom, v.forward, 1),
                               side(v.up, v.tan_top, v.forward, -1),
                               {big(v.forward), -Big(v.near_m)}};
  if (std::isfinite(v.far_m)) planes.push_back({big(-v.forward), Big(v.far_m)});
  return planes;
}

TEST_CASE("planes are exact to four units") {
  Random random(11);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const View view = random_view(random, eyes()[random.below(5)]);
    const FrustumD frustum = make_frustum(view);
    const auto exact = big_planes(view);
    REQUIRE(static_cast<std::size_t>(frustum.count) == exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const Big off = length(combine(big(frustum.planes[k].normal), -1, exact[k].normal));
      worst = std::max(worst, static_cast<double>(off));
      REQUIRE(frustum.planes[k].offset == static_cast<double>(exact[k].offset));
    }
  }
  INFO("seed 11, worst " << worst / kUnit << " units");
  CHECK(worst <= 4 * kUnit);
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
  CHECK(frustum.planes[kRight].offset == 0);
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
}

}  // namespace
}  // namespace manzana::culling::test
