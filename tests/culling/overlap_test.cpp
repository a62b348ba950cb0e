// Predicates against exact answers: nothing that is seen may be called outside [numerics 2].
#include "culling/overlap.h"

#include <catch2/catch.hpp>
#include <iostream>

#include "tests/culling/polytope.h"

namespace manzana::culling::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
/// What double leaves of a position at 5e6 m, and more than what it leaves of the oracle's own.
constexpr Real kDoubt = 1e-11L;

struct Tally {
  std::uint64_t asked = 0, truly = 0, lost = 0, accepted = 0, falsely_inside = 0;
  void add(bool truth, bool wholly, Overlap answer) {
    ++asked;
    truly += truth ? 1U : 0U;
    accepted += answer != Overlap::outside ? 1U : 0U;
    lost += truth && answer == Overlap::outside ? 1U : 0U;
    falsely_inside += !wholly && answer == Overlap::inside ? 1U : 0U;
  }
  void check(const char* what) const {
    std::cout << what << ": " << asked << " asked, " << truly << " truly, " << accepted << " accepted, " << lost
              << " lost\n";
    CHECK(lost == 0);
    CHECK(falsely_inside == 0);
    CHECK(accepted - truly < asked - truly);  // something is culled at all
  }
};

/// The camera's answers are asked for relative to an origin some way off, as a tree's.
struct Setting {
  View view;
  Polytope truth;
  Vec3d origin;
  Frustum frustum;
  double reach;
};
Setting random_setting(Random& random, const Vec3d& eye) {
  const View view = random_view(random, eye);
  const Vec3d origin = glm::round(eye + random.direction() * random.scale(1, 2e6));
  const double reach = random.scale(10, std::isfinite(view.far_m) ? view.far_m : 1e5);
  return {view, make_polytope(view), origin, narrow(make_frustum(view), origin), reach};
}

/// Certainly no part of the ball is beyond a plane.
bool wholly_inside(const Polytope& p, const Vec3l& c, Real r) {
  return std::all_of(p.planes.begin(), p.planes.end(),
                     [&](const PlaneL& k) { return glm::dot(k.normal, c) + k.offset >= r - kDoubt; });
}

void ask(const Setting& set, const SphereD& ball, Tally& tally) {
  const Vec3l c = Vec3l(ball.center) - Vec3l(set.view.eye);
  const Real r = static_cast<Real>(ball.radius);
  const bool truth = distance_to(set.truth, c) <= r - (ball.radius > 0 ? kDoubt : 0);
  const Sphere small = narrow(ball, set.origin);
  tally.add(truth, wholly_inside(set.truth, c, r), overlap(set.frustum, small));
}

SphereD uniform_sphere(const Setting& set, Random& random) {
  const Vec3d c = set.view.eye + random.direction() * random.in(0, set.reach);
  return {c, random.unit() < 0.05 ? 0 : random.scale(1e-3, 0.3 * set.reach)};
}

SphereD tangent_sphere(const Setting& set, Random& random) {
  const Touch t = touch(set.truth, random, static_cast<int>(random.below(3)), set.reach);
  const double r = random.scale(1e-2, 1e3);
  const double depth = random.scale(1e-9, 1e-1) * (random.unit() < 0.8 ? 1 : -1);
  return {set.view.eye + Vec3d(t.point + t.away * static_cast<Real>(r - depth)), r};
}

/// In double, against all planes.
void ask_in_double(const Setting& set, const FrustumD& frustum, const SphereD& ball, Tally& tally) {
  const Vec3l c = Vec3l(ball.center) - Vec3l(set.view.eye);
  const Real r = static_cast<Real>(ball.radius);
  const bool truth = distance_to(set.truth, c) <= r - (ball.radius > 0 ? kDoubt : 0);
  const bool gone = outside(frustum, kAllPlanes, ball);
  tally.add(truth, true, gone ? Overlap::outside : Overlap::crosses);
  bool any = false;
  for (unsigned k = 0; k < 8; ++k) any |= outside(frustum, 1U << k, ball);
  REQUIRE(any == gone);
  REQUIRE(!outside(frustum, 0, ball));
}

TEST_CASE("sphere and frustum in double: nothing is lost") {
  Tally uniform, tangent;
  for (const Vec3d& eye : eyes()) {
    Random random(33);
    for (int camera = 0; camera < 100; ++camera) {
      const Setting set = random_setting(random, eye);
      const FrustumD frustum = make_frustum(set.view);
      for (int i = 0; i < 700; ++i) ask_in_double(set, frustum, uniform_sphere(set, random), uniform);
      for (int i = 0; i < 700; ++i) ask_in_double(set, frustum, tangent_sphere(set, random), tangent);
    }
  }
  uniform.check("spheres in double, uniform (seed 33)");
  tangent.check("spheres in double, tangent");
}

TEST_CASE("sphere and frustum in double: a NaN never culls and empty spheres are outside") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FrustumD frustum = make_frustum(look({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1));
  CHECK(outside(frustum, kAllPlanes, {{0, -50, 0}, 1}));
  CHECK(!outside(frustum, kAllPlanes, {{nan, -50, 0}, 1}));
  CHECK(outside(frustum, kAllPlanes, SphereD{}));
  for (PlaneD& plane : frustum.planes) plane.offset = nan;
  CHECK(!outside(frustum, kAllPlanes, {{0, -50, 0}, 1}));
}

void ask_spheres(int per_camera, int cameras) {
  Tally uniform, tangent;
  for (const Vec3d& eye : eyes()) {
    Random random(31);
    for (int camera = 0; camera < cameras; ++camera) {
      const Setting set = random_setting(random, eye);
      for (int i = 0; i < per_camera; ++i) ask(set, uniform_sphere(set, random), uniform);
      for (int i = 0; i < per_camera; ++i) ask(set, tangent_sphere(set, random), tangent);
    }
  }
  uniform.check("spheres, uniform (seed 31)");
  tangent.check("spheres, tangent");
}

TEST_CASE("sphere and frustum: nothing is lost") { ask_spheres(1500, 100); }
TEST_CASE("sphere and frustum: nothing is lost, ten million", "[.long]") { ask_spheres(10000, 200); }

void ask(const Setting& set, const ExactView& exact, const BoxD& box, Tally& tally) {
  const Box small = narrow(box, set.origin);
  bool wholly = true;
  for (int k = 0; k < 8 && wholly; ++k) {
    const Vec3d corner{k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z};
    wholly = holds(set.truth, Vec3l(corner) - Vec3l(set.view.eye), kDoubt);
  }
  tally.add(exactly_overlaps(exact, box), wholly, overlap(set.frustum, small));
}

BoxD uniform_box(const Setting& set, Random& random) {
  const Vec3d c = set.view.eye + random.direction() * random.in(0, set.reach);
  if (random.unit() < 0.03) return {c, c};                                    // a point
  if (random.unit() < 0.03) return {c, c + Vec3d(random.in(0, 50), 0, 0)};    // a line
  if (random.unit() < 0.03) return {set.view.eye - 1e7, set.view.eye + 1e7};  // all round
  const Vec3d size{random.scale(1e-9, 0.3 * set.reach), random.scale(1e-3, 0.3 * set.reach), random.scale(1, 100)};
  return {c - size, c + size};
}

/// Its corner lies a little below a point of the surface.
BoxD tangent_box(const Setting& set, Random& random) {
  const Touch t = touch(set.truth, random, static_cast<int>(random.below(3)), set.reach);
  const Real depth = static_cast<Real>(random.scale(1e-9, 1e-1) * (random.unit() < 0.8 ? 1 : -1));
  const Vec3d corner = set.view.eye + Vec3d(t.point - t.away * depth);
  const Vec3d size{random.scale(1e-3, 1e3), random.scale(1e-3, 1e3), random.scale(1e-3, 1e3)};
  return merge(BoxD{corner, corner}, corner + glm::sign(Vec3d(t.away)) * size);
}

TEST_CASE("box and frustum: nothing is lost") {
  Tally uniform, tangent;
  for (const Vec3d& eye : eyes()) {
    Random random(32);
    for (int camera = 0; camera < 100; ++camera) {
      const Setting set = random_setting(random, eye);
      const ExactView exact = make_exact(set.view);
      for (int i = 0; i < 700; ++i) {
        ask(set, exact, uniform_box(set, random), uniform);
        ask(set, exact, tangent_box(set, random), tangent);
      }
    }
  }
  uniform.check("boxes, uniform (seed 32)");
  tangent.check("boxes, tangent");
}

/// There the float operands vanish, and with them their margin: what double rounded must be allowed for.
TEST_CASE("a point in the origin, on a side far from the eye, is not lost") {
  Random random(35);
  int inside = 0, lost = 0;
  for (int i = 0; i < 6000; ++i) {
    const View view = random_view(random, eyes()[random.below(eyes().size())]);
    const Vec3d point = view.eye + Vec3d(touch(make_polytope(view), random, 0, 1e6).point);
    if (!exactly_overlaps(view, BoxD{point, point})) continue;
    ++inside;
    const Frustum frustum = narrow(make_frustum(view), point);
    const bool ball = overlap(frustum, narrow(SphereD{point, 0}, point)) != Overlap::outside;
    const bool box = overlap(frustum, narrow(BoxD{point, point}, point)) != Overlap::outside;
    lost += ball && box ? 0 : 1;
  }
  CHECK(inside > 600);
  CHECK(lost == 0);
}

Frustum simple_frustum(double far_m = 100) {
  return narrow(make_frustum(look(Vec3d(0), {0, 1, 0}, {0, 0, 1}, 1, 1, 0.1, far_m)), Vec3d(0));
}

TEST_CASE("three answers") {
  const Frustum f = simple_frustum();
  CHECK(overlap(f, Sphere{{0, 50, 0}, 1}) == Overlap::inside);
  CHECK(overlap(f, Sphere{{0, -50, 0}, 1}) == Overlap::outside);
  CHECK(overlap(f, Sphere{{0, 0, 0}, 1}) == Overlap::crosses);
  CHECK(overlap(f, Sphere{{0, 0, 0}, 1e9F}) == Overlap::crosses);
  CHECK(overlap(f, Box{Vec3(-1, 50, -1), Vec3(1, 51, 1)}) == Overlap::inside);
  CHECK(overlap(f, Box{Vec3(-1, 150, -1), Vec3(1, 151, 1)}) == Overlap::outside);
  CHECK(overlap(f, Box{Vec3(-1e30F), Vec3(1e30F)}) == Overlap::crosses);
  CHECK(overlap(f, Box{Vec3(-1, 100, -1), Vec3(1, 120, 1)}) == Overlap::crosses);  // touches the far plane
  CHECK(overlap(simple_frustum(std::numeric_limits<double>::infinity()), Sphere{{0, 1e8F, 0}, 1}) == Overlap::inside);
}

TEST_CASE("empty shapes are outside, whatever stands in them") {
  const Frustum f = simple_frustum();
  CHECK(overlap(f, Sphere{}) == Overlap::outside);
  CHECK(overlap(f, Sphere{{0, 50, 0}, -1}) == Overlap::outside);
  CHECK(overlap(f, Box{}) == Overlap::outside);
  CHECK(overlap(f, Box{Vec3(1, 50, 1), Vec3(-1, 51, 2)}) == Overlap::outside);
}

TEST_CASE("a NaN keeps the shape, and a plane with one never culls") {
  const Frustum f = simple_frustum();
  for (int k = 0; k < 3; ++k) {
    Sphere ball{{0, -50, 0}, 1};
    ball.center[k] = kNan;
    CHECK(overlap(f, ball) == Overlap::crosses);
    Box low{Vec3(-1, -51, -1), Vec3(1, -50, 1)}, high = low;
    low.min[k] = kNan;
    high.max[k] = kNan;
    CHECK(overlap(f, low) == Overlap::crosses);
    CHECK(overlap(f, high) == Overlap::crosses);
  }
  CHECK(overlap(f, Sphere{{0, -50, 0}, kNan}) == Overlap::crosses);
  Frustum broken = f;
  broken.count = 1;
  broken.planes[0].offset = kNan;
  CHECK(overlap(broken, Sphere{{-1e6F, -50, 0}, 1}) == Overlap::crosses);
}

TEST_CASE("infinite shapes are kept") {
  const Frustum f = simple_frustum();
  CHECK(overlap(f, Sphere{{0, -50, 0}, kInf}) == Overlap::crosses);
  CHECK(overlap(f, Sphere{{kInf, 0, 0}, 1}) == Overlap::crosses);
  CHECK(overlap(f, Box{Vec3(-kInf), Vec3(kInf)}) == Overlap::crosses);
}

TEST_CASE("a leaf is accepted when its sphere and its box are") {
  Random random(33);
  int accepted = 0;
  for (int i = 0; i < 50000; ++i) {
    const Setting set = random_setting(random, Vec3d(0));
    const BoxD box = uniform_box(set, random);
    const Box b = narrow(box, set.origin);
    const Sphere s = narrow(enclosing_sphere(box), set.origin);
    const Overlap ball = overlap(set.frustum, s), cuboid = overlap(set.frustum, b), leaf = overlap(set.frustum, s, b);
    REQUIRE((leaf != Overlap::outside) == (ball != Overlap::outside && cuboid != Overlap::outside));
    if (ball == Overlap::inside || (cuboid == Overlap::inside && leaf != Overlap::outside))
      REQUIRE(leaf == Overlap::inside);
    accepted += leaf != Overlap::outside ? 1 : 0;
  }
  CHECK(accepted > 1000);
  CHECK(accepted < 49000);
}

}  // namespace
}  // namespace manzana::culling::test
