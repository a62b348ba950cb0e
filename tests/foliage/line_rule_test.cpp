#include "foliage/line_rule.h"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "foliage/branch_levels.h"
#include "foliage/random.h"
#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The formulas as they stand, in 50 digits.
LineCounts by_definition(const LineCloud& c, double r, double spacing, const LineRule& rule) {
  const Exact q = Exact(c.area_m2) / (2 * Exact(rule.line) * Exact(r) * Exact(c.length_m) * Exact(spacing));
  const Exact width = Exact(c.width_m) / (Exact(r) * Exact(spacing));
  const Exact n = Exact(c.lines), one = 1, none = 0;
  if (!rule.gradual) return width <= 1 && q < 1 ? LineCounts{1, static_cast<double>(q * n)} : LineCounts{};
  const Exact turned = std::clamp(std::min<Exact>(2 - q, 2 - 2 * width), none, one);
  return {static_cast<double>(turned), static_cast<double>(turned * std::min(q, one) * n)};
}

double power(Random& random, double least, double most) {
  return std::exp2(least + (most - least) * static_cast<double>(random.uniform()));
}

LineCloud twigs() { return {0.02 * 3.141592653589793 * 100, 100, 0.02, 1000}; }  // 1000 round twigs of 2 cm

}  // namespace

TEST_CASE("line counts are those of the formulas in many digits") {
  Random random(1);
  int turned = 0;
  for (int round = 0; round < 20'000; ++round) {
    const double width = power(random, -30, 10), length = power(random, -10, 30);
    const LineCloud cloud{width * length * power(random, -2, 2), length, width, 1 + random.bits() % (1ULL << 32)};
    const double spacing = power(random, -16, 2), r = width / spacing * power(random, -3, 12);
    for (const LineRule& rule : {LineRule{}, kSourceLineRule}) {
      const LineCounts is = line_counts(cloud, r, spacing, rule), should = by_definition(cloud, r, spacing, rule);
      CHECK(is.turned == Approx(should.turned).margin(1e-12));
      CHECK(is.drawn == Approx(should.drawn).epsilon(1e-12).margin(1e-12 * static_cast<double>(cloud.lines)));
      turned += is.turned > 0 ? 1 : 0;
    }
  }
  CHECK(turned > 10'000);
}

TEST_CASE("the source's twig of two centimetres turns at 12 and a half metres") {
  const double f_px = 1080 / (2 * std::tan(3.141592653589793 / 6)), spacing = 1.5 / f_px;
  LineCloud cloud = twigs();
  cloud.area_m2 *= 0.2;  // q is under 1 before the width is
  CHECK(line_counts(cloud, 12.4, spacing, kSourceLineRule).turned == 0);
  CHECK(line_counts(cloud, 12.5, spacing, kSourceLineRule).turned == 1);
}

TEST_CASE("round things begin to turn where their width is the spacing and have turned at half of it") {
  const LineCloud cloud = twigs();
  const double spacing = 0.001, at = cloud.width_m / spacing;
  CHECK(line_counts(cloud, at * 0.999, spacing, {}).turned == 0);
  CHECK(line_counts(cloud, at * 4 / 3, spacing, {}).turned == Approx(0.5));
  CHECK(line_counts(cloud, at * 2, spacing, {}).turned == Approx(1));
  CHECK(line_counts(cloud, at * 2, spacing, {}).drawn == Approx(1000));
  CHECK(line_counts(cloud, at * 4, spacing, {}).drawn == Approx(500));  // lines cover the spacing: half as many
}

TEST_CASE("gradual counts have no jump and go one way") {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    const LineCloud cloud{power(random, -8, 4), power(random, -4, 8), power(random, -10, 0), 1 + random.bits() % 1000};
    const double spacing = power(random, -12, -6);
    LineCounts before = line_counts(cloud, 0x1p-20, spacing, {});
    constexpr double kStep = 1e-3;
    bool one_way = true, no_jump = true;
    for (double r = 0x1p-20; r < 0x1p20; r *= 1 + kStep) {
      const LineCounts now = line_counts(cloud, r, spacing, {});
      const double all = static_cast<double>(cloud.lines);
      no_jump = no_jump && now.turned - before.turned <= 2.1 * kStep &&
                std::abs(now.drawn - before.drawn) <= 3.1 * kStep * all;
      one_way = one_way && now.turned >= before.turned && (before.turned < 1 || now.drawn <= before.drawn) &&
                now.drawn <= now.turned * all;
      before = now;
    }
    CHECK(no_jump);
    CHECK(one_way);
  }
}

TEST_CASE("line counts stay finite at the extremes") {
  for (const LineRule& rule : {LineRule{}, kSourceLineRule}) {
    const auto at = [&](const LineCloud& cloud, double r) { return line_counts(cloud, r, 0.001, rule); };
    for (const double r : {0.0, -0.0, -1.0, -kInf, kNan, 5e-324, 1e-308}) CHECK(at(twigs(), r).turned == 0);
    for (const double r : {1e308, kInf}) {
      CHECK(at(twigs(), r).turned == 1);
      CHECK(at(twigs(), r).drawn <= 1e-290);
    }
    CHECK(at({1, 0, 0.1, 5}, 1).turned == 0);
    CHECK(at({1, 1, 0.1, 0}, 1).drawn == 0);
    CHECK(at({0, 1, 0, 5}, 1).drawn == 0);
    CHECK(at({1e300, 1e-300, 0, 5}, kInf).drawn == 0);
    CHECK(std::isfinite(at({1e300, 1e-300, 1e300, 5}, 1e300).drawn));
    CHECK(std::isfinite(at({1, 1, 0, std::numeric_limits<std::uint64_t>::max()}, 1e4).drawn));
  }
}

TEST_CASE("measures that are none are refused") {
  for (const double bad : {-1.0, kInf, kNan}) {
    CHECK_THROWS_AS(line_counts({bad, 1, 1, 1}, 1, 1, {}), std::invalid_argument);
    CHECK_THROWS_AS(line_counts({1, bad, 1, 1}, 1, 1, {}), std::invalid_argument);
    CHECK_THROWS_AS(line_counts({1, 1, bad, 1}, 1, 1, {}), std::invalid_argument);
    CHECK_THROWS_AS(line_counts(twigs(), 1, bad, {}), std::invalid_argument);
    CHECK_THROWS_AS(line_counts(twigs(), 1, 1, {bad, true}), std::invalid_argument);
  }
  CHECK_THROWS_AS(line_counts(twigs(), 1, 0, {}), std::invalid_argument);
  CHECK_THROWS_AS(line_counts(twigs(), 1, 1, {0, true}), std::invalid_argument);
}

TEST_CASE("the lines of a plant have the surface of its branches") {
  const Plant plant = spiral_plant(30);
  PreparedPlant ready;
  prepare_branches(plant, {}, ready);
  const LineCloud cloud = line_cloud(ready.lines);
  double surface = 0;
  for (std::size_t i = 0; i < plant.mesh.bark.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return Vec3d(plant.mesh.bark.vertices[plant.mesh.bark.indices[i + k]].position);
    };
    surface += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
  }
  CHECK(cloud.area_m2 == Approx(surface).epsilon(0.01));
  CHECK(cloud.width_m == Approx(0.4).epsilon(0.2));
  CHECK(cloud.lines == ready.lines.size());
}

}  // namespace manzana::foliage
