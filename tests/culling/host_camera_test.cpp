// The frustum of a host's own matrices, against the same planes in fifty digits [numerics 1].
#include "culling/host_camera.h"

#include <catch2/catch.hpp>
#include <cfloat>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>

#include "culling/baselines/exact_planes.h"
#include "culling/baselines/host_matrices.h"
#include "culling/baselines/places.h"
#include "culling/baselines/random.h"
#include "culling/overlap.h"

namespace manzana::culling::test {
namespace {

using baselines::Depths;
using baselines::host_matrices;
using baselines::HostMatrices;
using baselines::Random;

constexpr double kUnit = DBL_EPSILON / 2;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kClipDepths{ClipDepth::minus_one_to_one, ClipDepth::zero_to_one, ClipDepth::reversed};

HostFrustum make_frustum(const HostMatrices& host) { return make_frustum(host.projection, host.view, host.depth); }

/// Some mirrored, some off the axis, some both.
View random_view(Random& random, const Vec3d& eye, double fov_deg, double aspect, const Depths& depths) {
  View view =
      look(eye, random.direction(), random.direction(), glm::radians(fov_deg), aspect, depths.near_m, depths.far_m);
  if (random.chance(0.3)) view.right = -view.right;
  if (random.chance(0.3)) view.tan_left = random.in(-0.5, 0.9) * view.tan_right;
  if (random.chance(0.3)) view.tan_bottom = random.in(-0.5, 0.9) * view.tan_top;
  return view;
}

/// Every place, depth, field and aspect, under all three conventions of depth.
template <class F>
void for_each_camera(std::uint64_t seed, F&& f) {
  Random random(seed);
  for (const auto& place : baselines::kPlaces)
    for (const Depths& depths : baselines::kDepths)
      for (const double fov : baselines::kFieldsDeg)
        for (const double aspect : baselines::kAspects) {
          INFO("seed " << seed << ", " << place.name << ", n " << depths.near_m << ", f " << depths.far_m << ", " << fov
                       << " degrees, aspect " << aspect);
          const View view = random_view(random, place.at + random.direction(), fov, aspect, depths);
          for (const ClipDepth depth : kClipDepths) f(view, depth, random);
        }
}

struct Worst {
  double angle = 0, offset = 0;  ///< units in the last place: of 1, and of the far distance (at least 1 m)
  int planes = 0;
  void add(const PlaneD& plane, const BigPlane& exact, double far_m) {
    angle = std::max(angle, static_cast<double>(length(cross(big(plane.normal), exact.normal))) / kUnit);
    const double off = std::abs(static_cast<double>(plane.offset - exact.offset));
    const double size = std::isfinite(far_m) ? far_m : static_cast<double>(abs(exact.offset));
    offset = std::max(offset, off / kUnit / std::max(1.0, size));
    ++planes;
  }
  void check(int at_least) const {
    INFO("worst of " << planes << ": angle " << angle << " units, offset " << offset);
    CHECK(planes >= at_least);
    CHECK(angle <= 4);
    CHECK(offset <= 4);
  }
};

/// All planes but the far one, which is moved outward on purpose.
void compare(const HostMatrices& host, double far_m, Worst& worst) {
  const HostFrustum seen = make_frustum(host);
  const BigPlanes exact = exact_planes(host.projection, host.view, host.depth, seen.frustum.eye);
  for (std::size_t k = 0; k < 5; ++k) worst.add(seen.frustum.planes[k], exact[k], far_m);
}

TEST_CASE("planes of matrices are exact to four units, at any place") {
  Worst worst;
  for_each_camera(
      81, [&](const View& view, ClipDepth depth, Random&) { compare(host_matrices(view, depth), view.far_m, worst); });
  worst.check(12000);
}

TEST_CASE("planes of matrices: the scale of the projection and of the view does not matter") {
  Worst worst;
  for_each_camera(82, [&](const View& view, ClipDepth depth, Random& random) {
    HostMatrices host = host_matrices(view, depth);
    for (const double scale : {1e-23, 1e20}) {
      HostMatrices scaled = host;
      scaled.projection *= scale;
      compare(scaled, view.far_m, worst);
      REQUIRE(make_frustum(scaled).far_plane == make_frustum(host).far_plane);
    }
    // A host that counts in other units, sheared for good measure.
    const double unit = random.scale(1e-3, 1e3);
    Mat4d change(unit);
    change[3][3] = 1;
    change[1][0] = unit * random.in(-0.5, 0.5);
    host.view = change * host.view;
    compare(host, view.far_m / unit, worst);
  });
  worst.check(36000);
}

TEST_CASE("planes of matrices: orthographic, from a centimetre to a thousand kilometres") {
  Random random(83);
  Worst worst;
  for (const auto& place : baselines::kPlaces)
    for (int i = 0; i < 200; ++i) {
      const double size = random.scale(1e-2, 1e6);
      View view = random_view(random, place.at, 90, random.scale(0.1, 10), {1, 2});
      view.near_m = -random.in(0, size);  // behind the eye is in view too
      view.far_m = random.scale(1, 1e6);
      for (const ClipDepth depth : kClipDepths) {
        const HostMatrices host = baselines::orthographic_matrices(view, size / 2, depth);
        const HostFrustum seen = make_frustum(host);
        REQUIRE(seen.far_plane == FarPlane::kept);
        compare(host, std::max(view.far_m, size * 10), worst);
        const BigPlanes exact = exact_planes(host.projection, host.view, depth, seen.frustum.eye);
        worst.angle = std::max(
            worst.angle,
            static_cast<double>(length(cross(big(seen.frustum.planes[kFar].normal), exact[kFar].normal))) / kUnit);
        const double outward = static_cast<double>(seen.frustum.planes[kFar].offset - exact[kFar].offset);
        REQUIRE(outward >= 0);
        REQUIRE(outward <= 64 * kUnit * (view.far_m + size));
      }
    }
  worst.check(20000);
}

/// Where the plane really cuts the axis of the view; the eye is where the host's rounding has put it.
double far_distance(const HostFrustum& seen, const View& view) {
  const PlaneD& far_plane = seen.frustum.planes[kFar];
  return far_plane.offset + glm::dot(far_plane.normal, view.eye - seen.frustum.eye);
}

TEST_CASE("the far plane of double matrices is never nearer than the camera's, and not much farther") {
  int kept = 0;
  for_each_camera(84, [&](const View& view, ClipDepth depth, Random&) {
    const HostMatrices host = host_matrices(view, depth);
    const HostFrustum seen = make_frustum(host);
    const bool finite = std::isfinite(view.far_m);
    REQUIRE(seen.far_plane == (finite ? FarPlane::kept : FarPlane::none));
    REQUIRE(seen.frustum.count == (finite ? 6 : 5));
    if (!finite) return;
    ++kept;
    const double f = view.far_m, allowed = 8 * kUnit * f * f / view.near_m;
    CHECK(far_distance(seen, view) >= f * (1 - 4 * kUnit));
    // The host's own rounding and what is added for it; at the pole the eye itself is off by 1e-9 m.
    CHECK(far_distance(seen, view) <= f + 2 * allowed + 64 * kUnit * f + 1e-8);
  });
  CHECK(kept > 2000);
}

TEST_CASE("a matrix that went through float loses its far plane, and says so") {
  int asked = 0;
  for_each_camera(85, [&](const View& view, ClipDepth depth, Random&) {
    const HostMatrices host = host_matrices(view, depth);
    const Mat4 narrow_projection(host.projection), narrow_view(host.view);
    for (const HostFrustum& seen : {make_frustum(narrow_projection, host.view, depth),  // widened by GLM unasked
                                    make_frustum(Mat4d(narrow_projection), Mat4d(narrow_view), depth),
                                    make_frustum(narrow_projection * narrow_view, Mat4d(1), depth)}) {
      REQUIRE(seen.far_plane == FarPlane::lost_in_float);
      REQUIRE(seen.frustum.count == 5);
      ++asked;
    }
  });
  CHECK(asked > 7000);
}

TEST_CASE("infinite projections of GLM have no far plane") {
  const Mat4d view = glm::lookAt(Vec3d(1, 2, 3), Vec3d(40, 50, 6), Vec3d(0, 0, 1));
  for (const double n : {1e-3, 0.1, 0.3, 1.0}) {
    CHECK(make_frustum(glm::infinitePerspective(1.0, 1.6, n), view, ClipDepth::minus_one_to_one).far_plane ==
          FarPlane::none);
    CHECK(make_frustum(glm::tweakedInfinitePerspective(1.0, 1.6, n), view, ClipDepth::minus_one_to_one).far_plane ==
          FarPlane::none);
    // The epsilon of float: a far plane at 2n / epsilon, millions of near distances away, which double knows well.
    const double epsilon = static_cast<double>(FLT_EPSILON);
    const HostFrustum tweaked =
        make_frustum(glm::tweakedInfinitePerspective(1.0, 1.6, n, epsilon), view, ClipDepth::minus_one_to_one);
    CHECK(tweaked.far_plane == FarPlane::kept);
    CHECK(tweaked.frustum.planes[kFar].offset == Approx(2 * n / epsilon).epsilon(1e-6));
    const auto narrow_n = static_cast<float>(n);
    CHECK(make_frustum(glm::tweakedInfinitePerspective(1.0F, 1.6F, narrow_n), Mat4(view), ClipDepth::minus_one_to_one)
              .far_plane == FarPlane::lost_in_float);
  }
}

TEST_CASE("GLM's finite projections: what they name left is left, near near and far far") {
  const Mat4d view(1);  // along -z
  const auto check = [&](const Mat4d& projection, ClipDepth depth) {
    const FrustumD f = make_frustum(projection, view, depth).frustum;
    REQUIRE(f.count == 6);
    CHECK(f.planes[kLeft].normal.x > 0.1);
    CHECK(f.planes[kRight].normal.x < -0.1);
    CHECK(f.planes[kBottom].normal.y > 0.1);
    CHECK(f.planes[kTop].normal.y < -0.1);
    CHECK(f.planes[kNear].normal.z == Approx(-1));
    CHECK(f.planes[kNear].offset == Approx(-0.3));
    CHECK(f.planes[kFar].normal.z == Approx(1));
    CHECK(f.planes[kFar].offset == Approx(70.1));
  };
  check(glm::perspectiveRH_NO(1.0, 1.6, 0.3, 70.1), ClipDepth::minus_one_to_one);
  check(glm::perspectiveRH_ZO(1.0, 1.6, 0.3, 70.1), ClipDepth::zero_to_one);
  check(glm::perspectiveRH_ZO(1.0, 1.6, 70.1, 0.3), ClipDepth::reversed);
  check(glm::frustumRH_NO(-0.1, 0.3, -0.2, 0.1, 0.3, 70.1), ClipDepth::minus_one_to_one);
  check(glm::orthoRH_NO(-10.1, 30.0, -20.0, 10.0, 0.3, 70.1), ClipDepth::minus_one_to_one);
  check(glm::orthoRH_ZO(-10.1, 30.0, -20.0, 10.0, 70.1, 0.3), ClipDepth::reversed);
}

TEST_CASE("matrices that are no camera cull nothing") {
  const Mat4d good = glm::perspectiveRH_NO(1.0, 1.6, 0.3, 70.1);
  const auto planes = [](const Mat4d& projection, const Mat4d& view) {
    const FrustumD f = make_frustum(projection, view, ClipDepth::minus_one_to_one).frustum;
    int real = 0;
    for (int k = 0; k < f.count; ++k) {
      const PlaneD& plane = f.planes[static_cast<std::size_t>(k)];
      const bool none = plane.normal == Vec3d(0) && plane.offset == kNoPlane.offset;
      if (!none) CHECK(glm::length(plane.normal) == Approx(1));
      real += none ? 0 : 1;
    }
    CHECK(std::isfinite(f.eye.x + f.eye.y + f.eye.z));
    return real;
  };
  CHECK(planes(good, Mat4d(1)) == 6);
  CHECK(planes(Mat4d(0), Mat4d(1)) == 0);
  CHECK(planes(Mat4d(kNan), Mat4d(1)) == 0);
  Mat4d one_bad = good;
  one_bad[0][0] = kNan;  // of x: neither left nor right
  CHECK(planes(one_bad, Mat4d(1)) == 4);
  one_bad[0][0] = std::numeric_limits<double>::infinity();
  CHECK(planes(one_bad, Mat4d(1)) == 4);
  Mat4d no_place(1);
  no_place[3] = {kNan, 0, 0, 1};
  CHECK(planes(good, no_place) == 0);
  Mat4d flat(1);  // a view without an inverse
  flat[1] = {0, 0, 0, 0};
  CHECK(planes(good, flat) == 6);
}

TEST_CASE("a plane that is missing leaves room for inside, and for nothing outside") {
  Mat4d open = glm::perspectiveRH_NO(1.0, 1.6, 0.3, 70.1);
  open[0][0] = kNan;
  const HostFrustum seen = make_frustum(open, Mat4d(1), ClipDepth::minus_one_to_one);
  for (const Vec3d& origin : {Vec3d(0), Vec3d(1e6, -4e6, 3)}) {
    const Frustum f = narrow(seen.frustum, origin);
    for (const double x : {0.0, 1e3, -1e4, 1e6, -1e9, 1e30}) {
      const Overlap answer = overlap(f, narrow(SphereD{{x, 0, -20}, 1}, origin));
      CHECK(answer != Overlap::outside);
      if (std::abs(x) < 1e5) CHECK(answer == Overlap::inside);
    }
  }
}

}  // namespace
}  // namespace manzana::culling::test
