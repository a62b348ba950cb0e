#include "scenegraph/import/centroid.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <numbers>

#include "tests/import/blocks/made_streets.h"

using namespace manzana;

namespace {

using Wide = boost::multiprecision::cpp_bin_float_100;

struct WideMoments {
  Wide area2 = 0, x = 0, y = 0;
};

// The textbook formula, unshifted, in 100 digits.
WideMoments wide_moments(const std::vector<Vec2d>& ring) {
  WideMoments m;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d &p = ring[i], &q = ring[(i + 1) % ring.size()];
    const Wide c = Wide(p.x) * Wide(q.y) - Wide(q.x) * Wide(p.y);
    m.area2 += c;
    m.x += (Wide(p.x) + Wide(q.x)) * c;
    m.y += (Wide(p.y) + Wide(q.y)) * c;
  }
  return m;
}

void require_exact(const Polygon& outline) {
  WideMoments sum = wide_moments(outline.outer);
  for (const auto& hole : outline.holes) {
    const WideMoments h = wide_moments(hole);
    const int sign = (sum.area2 < 0) == (h.area2 < 0) ? -1 : 1;
    sum.area2 += sign * h.area2;
    sum.x += sign * h.x;
    sum.y += sign * h.y;
  }
  const Centroid got = centroid(outline);
  REQUIRE_FALSE(got.box_center);
  const Wide x = sum.x / (3 * sum.area2), y = sum.y / (3 * sum.area2);
  CAPTURE(got.center.x, got.center.y, x.convert_to<double>(), y.convert_to<double>());
  REQUIRE(abs(x - Wide(got.center.x)) <= Wide(1e-9));
  REQUIRE(abs(y - Wide(got.center.y)) <= Wide(1e-9));
  REQUIRE(got.area == Approx(abs(sum.area2).convert_to<double>() / 2).epsilon(1e-6));
}

// Star-shaped parcel with 4 to 9 corners.
std::vector<Vec2d> parcel(std::uint64_t seed, double size, const Vec2d& at) {
  std::vector<Vec2d> ring;
  const int n = 4 + static_cast<int>(6 * test::random01(seed, 99));
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    const double radius = size * (0.25 + 0.25 * test::random01(seed, static_cast<std::uint64_t>(i)));
    ring.push_back(at + radius * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

const std::vector<Vec2d> kBow{{0, 0}, {10, 10}, {10, 0}, {0, 10}};

}  // namespace

TEST_CASE("centroid is that of 100 digits, from centimetres to a block, anywhere on Earth") {
  for (double size : {100.0, 20.0, 1.0, 0.01})
    for (const Vec2d& at : {Vec2d{0, 0}, Vec2d{1e4, 1e4}, Vec2d{1e5, -1e5}, Vec2d{676000, 4613000}, Vec2d{5e6, 5e6}})
      for (std::uint64_t seed = 0; seed < 50; ++seed) {
        CAPTURE(size, at.x, seed);
        require_exact({parcel(seed, size, at), {}});
      }
}

TEST_CASE("centroid takes rings in either direction, closed or open, with holes") {
  std::vector<Vec2d> ring = parcel(7, 100, {676000, 4613000});
  const std::vector<Vec2d> hole = parcel(8, 20, {676003, 4613001});
  const Vec2d open = centroid({ring, {hole}}).center;
  require_exact({ring, {hole}});
  require_exact({ring, {{hole.rbegin(), hole.rend()}}});
  require_exact({{ring.rbegin(), ring.rend()}, {hole}});
  CHECK(centroid({ring, {}}).center != open);
  ring.push_back(ring[0]);
  CHECK(glm::distance(centroid({ring, {hole}}).center, open) < 1e-9);
}

TEST_CASE("centroid of a square with an eccentric hole, by hand") {
  const Centroid c = centroid({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{6, 4}, {8, 4}, {8, 6}, {6, 6}}}});
  CHECK(c.area == 96);
  CHECK(c.center.x == Approx((500.0 - 4 * 7) / 96));
  CHECK(c.center.y == Approx(5));
}

TEST_CASE("a U's centroid may lie outside it") {
  const Centroid c = centroid({{{0, 0}, {30, 0}, {30, 30}, {29, 30}, {29, 1}, {1, 1}, {1, 30}, {0, 30}}, {}});
  CHECK_FALSE(c.box_center);
  CHECK(c.center.x == Approx(15));
  CHECK(c.center.y > 1);
}

TEST_CASE("outlines without an area have their box's centre") {
  const auto box = [](std::vector<Vec2d> ring) {
    const Centroid c = centroid({std::move(ring), {}});
    REQUIRE(c.box_center);
    REQUIRE(c.area == 0);
    return c.center;
  };
  CHECK(box({}) == Vec2d(0, 0));
  CHECK(box({{3, 4}}) == Vec2d(3, 4));
  CHECK(box({{3, 4}, {5, 8}}) == Vec2d(4, 6));
  CHECK(box({{0, 0}, {1, 1}, {4, 4}}) == Vec2d(2, 2));
  CHECK(box({{0, 0}, {10, 0}, {5, 1e-300}}) == Vec2d(5, 0.5e-300));
  CHECK(box(kBow) == Vec2d(5, 5));
  CHECK(box({{-1e308, -1e308}, {1e308, -1e308}, {1e308, 1e308}, {-1e308, 1e308}}) == Vec2d(0, 0));
}

TEST_CASE("nearly a bow-tie: never far away") {
  for (double skew : {1e-9, 1e-6, 1e-3, -1e-9, -1e-6, -1e-3}) {
    std::vector<Vec2d> ring = kBow;
    ring[1].y += skew;
    const Centroid c = centroid({ring, {}});
    CAPTURE(skew);
    CHECK(box_of(ring).contains(c.center));
  }
}
