#include "scenegraph/local_frame.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/support/random.h"

using namespace manzana;
using Real = boost::multiprecision::cpp_bin_float_50;

namespace {

struct Exact {
  Real x, y, z;
};

// The textbook formulas in 50 digits. [numerics 6]
Exact earth_centred(const GeoPoint& p) {
  using boost::multiprecision::cos, boost::multiprecision::sin, boost::multiprecision::sqrt;
  const Real pi = boost::math::constants::pi<Real>();
  const Real a = 6378137, f = Real(1) / Real("298.257223563"), e2 = f * (2 - f);
  const Real lat = Real(p.lat_deg) * pi / 180, lon = Real(p.lon_deg) * pi / 180, h = p.height_m;
  const Real n = a / sqrt(1 - e2 * sin(lat) * sin(lat));
  return {(n + h) * cos(lat) * cos(lon), (n + h) * cos(lat) * sin(lon), (n * (1 - e2) + h) * sin(lat)};
}

Exact exact_local(const GeoPoint& anchor, const GeoPoint& p) {
  using boost::multiprecision::cos, boost::multiprecision::sin;
  const Real pi = boost::math::constants::pi<Real>();
  const Real lat = Real(anchor.lat_deg) * pi / 180, lon = Real(anchor.lon_deg) * pi / 180;
  const Exact a = earth_centred(anchor), b = earth_centred(p);
  const Real dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  return {-sin(lon) * dx + cos(lon) * dy, -sin(lat) * cos(lon) * dx - sin(lat) * sin(lon) * dy + cos(lat) * dz,
          cos(lat) * cos(lon) * dx + cos(lat) * sin(lon) * dy + sin(lat) * dz};
}

double distance(const Exact& e, const Vec3d& p) {
  const Real dx = e.x - p.x, dy = e.y - p.y, dz = e.z - p.z;
  return static_cast<double>(boost::multiprecision::sqrt(dx * dx + dy * dy + dz * dz));
}

const std::vector<GeoPoint> kAnchors = {{41.65, -0.88, 0},    {0, 0, 0},       {90, 123, 0},  {-90, 0, 0},
                                        {89.9, 45, 0},        {-16.8, 180, 0}, {60, -180, 0}, {-30.03, -51.2, 250},
                                        {41.65, 539.5, 1000}, {-45, 170, -100}};

}  // namespace

TEST_CASE("to_local agrees with the closed formulas in 50 digits, and comes back") {
  support::Random random(7);
  for (const GeoPoint& anchor : kAnchors) {
    const LocalFrame frame(anchor);
    for (const double radius : {1.0, 1e2, 1e4, 1e5}) {
      for (int i = 0; i < 50; ++i) {
        const GeoPoint p =
            frame.to_geo({random.within(-radius, radius), random.within(-radius, radius), random.within(-50, 500)});
        REQUIRE(valid(p));
        const Vec3d local = frame.to_local(p);
        CHECK(distance(exact_local(anchor, p), local) < 5e-9);
        CHECK(glm::length(frame.to_local(frame.to_geo(local)) - local) < 1e-8);
      }
    }
  }
}

TEST_CASE("ground_z lies on the ellipsoid, and up_at is its normal") {
  support::Random random(8);
  for (const GeoPoint& anchor : kAnchors) {
    const LocalFrame frame({anchor.lat_deg, anchor.lon_deg, 0});
    for (const double radius : {0.0, 1e2, 1e4, 1e6}) {
      const Vec2d plan{random.within(-radius, radius), random.within(-radius, radius)};
      const Vec3d foot{plan.x, plan.y, frame.ground_z(plan)};
      const GeoPoint geo = frame.to_geo(foot);
      CHECK(std::abs(geo.height_m) < 2e-8);
      const Vec3d above = frame.to_local({geo.lat_deg, geo.lon_deg, 1000});
      CHECK(glm::length((above - foot) / 1000.0 - frame.up_at(plan)) < 1e-9);
    }
  }
}

TEST_CASE("ground falls below the tangent plane as the Earth curves") {
  const LocalFrame zaragoza({41.65, -0.88, 0});
  CHECK(zaragoza.ground_z({0, 1e3}) == Approx(-0.0786).margin(0.001));
  CHECK(zaragoza.ground_z({0, 1e4}) == Approx(-7.86).margin(0.02));
  CHECK(zaragoza.ground_z({1e5, 0}) == Approx(-784).margin(3));
}

TEST_CASE("block frames are orthonormal, right-handed, upright on their ground and lean on the scene's x") {
  for (const GeoPoint& anchor : kAnchors) {
    const LocalFrame frame({anchor.lat_deg, anchor.lon_deg, 0});
    for (const Vec2d plan : {Vec2d(0, 0), Vec2d(3e4, -2e4), Vec2d(-1e6, 1e6)}) {
      const BlockFrame block = block_frame(frame, plan);
      CHECK(glm::determinant(block.axes) == Approx(1).epsilon(1e-12));
      CHECK(glm::length(block.axes[2] - frame.up_at(plan)) < 1e-15);
      CHECK(std::abs(block.axes[0].y) < 0.2);
      const Vec3d p{3, -4, 5};
      CHECK(glm::length(block.to_block(block.to_local(p)) - p) < 1e-9);
      const Vec3d near = ground_point(frame, block, plan + Vec2d(100, 50), 7);
      CHECK(near.z == Approx(7).margin(0.01));  // 125 m on: the ground has fallen by a millimetre
    }
  }
}

TEST_CASE("centres are taken on the globe, not in longitudes") {
  const std::vector<GeoPoint> across = {{-16.8, 179.999, 0}, {-16.8, -179.999, 0}};
  CHECK(std::abs(std::abs(center_of(across).lon_deg) - 180) < 1e-9);
  const std::vector<GeoPoint> round_the_pole = {{89.999, 0, 0}, {89.999, 90, 0}, {89.999, 180, 0}, {89.999, -90, 0}};
  CHECK(center_of(round_the_pole).lat_deg == Approx(90).margin(1e-6));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<GeoPoint> odd = {{nan, 0, 0}, {91, 5, 0}, {10, 20, 0}};
  CHECK(center_of(odd).lat_deg == Approx(10));
  CHECK(center_of({}).lat_deg == 0);
}

TEST_CASE("medians are taken on the globe and strays do not draw them aside") {
  const std::vector<GeoPoint> across = {{-16.8, 179.999, 0}, {-16.8, -179.999, 0}, {-16.8, 180, 0}, {40, 10, 0}};
  CHECK(std::abs(median_of(across).lat_deg + 16.8) < 0.01);
  CHECK(std::abs(std::abs(median_of(across).lon_deg) - 180) < 0.01);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<GeoPoint> odd = {{nan, 0, 0}, {91, 5, 0}, {10, 20, 0}};
  CHECK(median_of(odd).lat_deg == Approx(10));
  CHECK(median_of({}).lat_deg == 0);
}

TEST_CASE("what is not on the globe is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const GeoPoint& p : {GeoPoint{90.0001, 0, 0}, GeoPoint{nan, 0, 0}, GeoPoint{0, nan, 0}, GeoPoint{0, 541, 0},
                            GeoPoint{0, inf, 0}, GeoPoint{0, 0, nan}}) {
    CHECK_FALSE(valid(p));
    CHECK_THROWS_AS(LocalFrame(p), std::invalid_argument);
  }
}
