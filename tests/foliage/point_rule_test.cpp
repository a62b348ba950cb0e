// Deussen's counts: exactly so many vertices, growing, without a gap (numerics.md 12.1).
#include "foliage/point_rule.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("points wanted are those of fifty digits") {
  using Big = boost::multiprecision::cpp_bin_float_50;
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const double area = 1e4 * static_cast<double>(random.uniform()),
                 r = 0.1 + 1e4 * static_cast<double>(random.uniform());
    const PointRule rule{.c_p = 1.5, .spacing_px = 0.5 + 3 * static_cast<double>(random.uniform())};
    const Big f(935.3), oracle = Big(rule.c_p) * f * f * Big(area) / (2 * Big(r) * Big(r)) / Big(rule.spacing_px) /
                                 Big(rule.spacing_px);
    CHECK(std::abs(points_wanted(area, r, 935.3, rule) / oracle.convert_to<double>() - 1) < 1e-14);
  }
}

TEST_CASE("points wanted inside the crown and far away") {
  const PointRule rule{.c_p = 1.2, .spacing_px = 1.5, .near_m = 0.001};
  CHECK(points_wanted(300, 0.001, 935.3, rule) == Approx(1.2 * 935.3 * 935.3 * 300 / 2 / 1e-6 / 2.25));
  CHECK(points_wanted(300, 0, 935.3, rule) == points_wanted(300, 0.001, 935.3, rule));
  CHECK(points_wanted(300, kInf, 935.3, rule) == 0);
  CHECK(point_counts(points_wanted(300, 0, 935.3, rule), 1000, 0).triangles == 1000);
  CHECK_THROWS_AS(points_wanted(1, 1, 900, {.spacing_px = 0}), std::invalid_argument);
  CHECK_THROWS_AS(points_wanted(1, 1, 900, {.spacing_px = kNan}), std::invalid_argument);
  CHECK_THROWS_AS(points_wanted(1, 1, 900, {.c_p = -1}), std::invalid_argument);
  CHECK_THROWS_AS(points_wanted(1, kNan, 900, {}), std::invalid_argument);
  CHECK_THROWS_AS(points_wanted(kInf, 1, 900, {}), std::invalid_argument);
}

TEST_CASE("triangles turn into points without a gap") {
  for (const std::uint64_t k : {1ULL, 2ULL, 7ULL, 1000ULL, 47'115ULL}) {
    PointCounts before;
    bool exact = true, growing = true, nested = true;
    const double step = static_cast<double>(k) / 7001;
    for (double p = 1; p < 3.2 * static_cast<double>(k); p += step) {
      const PointCounts now = point_counts(p, k, 0.5);
      exact = exact && now.vertices() == static_cast<std::uint64_t>(std::min(p, 3 * static_cast<double>(k)));
      growing = growing && now.vertices() >= before.vertices() && now.triangles >= before.triangles;
      // Points are never more than the triangles that are not drawn have.
      nested = nested && now.points <= 2 * (k - now.triangles);
      if (now.triangles > 0) nested = nested && now.points == 2 * (k - now.triangles);
      before = now;
    }
    CHECK(exact);
    CHECK(growing);
    CHECK(nested);
    CHECK(point_counts(3 * static_cast<double>(k), k, 0).triangles == k);
    CHECK(point_counts(kInf, k, 0).triangles == k);
    CHECK(point_counts(kNan, k, 0).triangles == k);
  }
  CHECK(point_counts(1e30, 0, 0).vertices() == 0);
}

TEST_CASE("a plant below one point is drawn as often as it is seen") {
  int drawn = 0;
  for (std::uint64_t plant = 0; plant < 10'000; ++plant)
    drawn += static_cast<int>(point_counts(0.2, 100, static_cast<double>(Random(plant).uniform())).points);
  CHECK(drawn == Approx(2000).margin(120));
  CHECK(point_counts(0, 100, 0).vertices() == 0);
  CHECK(point_counts(-5, 100, 0).vertices() == 0);
  CHECK(point_counts(0x1p-149, 100, 0).points == 1);
  CHECK(point_counts(0.999, 100, 0.9989).points == 1);
  CHECK(point_counts(1, 100, 0.9999).points == 1);
}

}  // namespace manzana::foliage
