// Fractions and counts of leaves on the inputs that break the printed formulas (numerics.md 9 and 11).
#include "foliage/lod_factor.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <limits>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;
constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();

double draw(Random& random) { return static_cast<double>(random.bits() >> 11) * 0x1p-53; }

}  // namespace

TEST_CASE("the power of distance is that of fifty digits") {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    const double h = 1 + std::exp2(40 * draw(random) - 20), z = std::exp2(60 * draw(random));
    const Big oracle = pow(Big(z), -log(Big(2)) / log(Big(h)));
    const double u = PowerFactor(h).at(z);
    if (oracle < Big(1e-300)) continue;
    const double tolerance = (3 * std::abs(std::log(u)) + 4) * 0x1p-53;
    // log2 of an h near 1 is as exact as h itself.
    worst = std::max(worst, (abs(Big(u) - oracle) / oracle).convert_to<double>() / tolerance);
  }
  CHECK(worst <= 1);
}

TEST_CASE("the power of distance stays in its range") {
  for (const double h : {1 + 1e-7, 1.5, 2.0, 1e30}) {
    const PowerFactor factor(h);
    double before = 1;
    for (const double z : {-1.0, -0.0, 0.0, 1e-38, 0.5, 1.0, std::nextafter(1.0, 2.0), 1.5, 2.0, 1e6, 1e300, kInf}) {
      const double u = factor.at(z);
      CHECK(u >= 0);
      CHECK(u <= before);
      if (z <= 1) CHECK(u == 1);
      before = u;
    }
    CHECK(factor.at(kInf) == 0);
    CHECK(factor.at(kNan) == 1);
    CHECK(factor.at(h) == Approx(0.5));
  }
  for (const double h : {0.0, 0.5, 1.0, -2.0, kInf, kNan}) CHECK_THROWS_AS(PowerFactor(h), std::invalid_argument);
}

TEST_CASE("the ramp falls from near to far") {
  const LinearRamp ramp(20, 100, 0.15);
  double before = 1;
  for (double d = 0; d < 120; d += 0.37) {
    CHECK(ramp.at(d) <= before);
    before = ramp.at(d);
  }
  CHECK(ramp.at(20) == 1);
  CHECK(ramp.at(60) == Approx(0.575));
  CHECK(ramp.at(100) == 0.15);
  CHECK(ramp.at(kInf) == 0.15);
  CHECK(ramp.at(kNan) == 1);
  const LinearRamp step(50, 50, 0.2);
  CHECK(step.at(50) == 1);
  CHECK(step.at(std::nextafter(50, 51)) == 0.2);
  CHECK_THROWS_AS(LinearRamp(100, 20, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(LinearRamp(-1, 20, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(LinearRamp(kNan, 20, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(LinearRamp(1, kInf, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(LinearRamp(1, 20, 1.1), std::invalid_argument);
  CHECK_THROWS_AS(LinearRamp(1, 20, kNan), std::invalid_argument);
}

TEST_CASE("kept leaves are the floor of the product") {
  const double below = std::nextafter(1.0, 0.0);
  for (const std::uint64_t n : {0ULL, 1ULL, 2ULL, 3ULL, 16'777'217ULL, 1'048'336'000ULL}) {
    CHECK(kept(n, 1) == n);
    CHECK(kept(n, 1 + 0x1p-52) == n);
    CHECK(kept(n, 0) == 0);
    CHECK(kept(n, -1) == 0);
    CHECK(kept(n, kNan) == n);
    CHECK(kept(n, 0x1p-149) == 0);
    CHECK(kept(n, below) == (n == 0 ? 0 : n - 1));
    std::uint64_t before = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double lod = i / 1000.0;
      const Big exact = floor(Big(n) * Big(lod));
      const std::uint64_t k = kept(n, lod);
      CHECK(k >= before);
      CHECK((Big(k) == exact || (i % 1000 != 0 && Big(k) == exact + 1 && Big(n) * Big(lod) - exact > 0.999999)));
      before = k;
    }
  }
  CHECK(4000 * kept(262'084, 1) * 3 == 3'145'008'000ULL);
}

TEST_CASE("thresholds share out what flooring loses") {
  std::uint64_t plain = 0, shared = 0;
  for (std::uint64_t cell = 0; cell < 10'000; ++cell) {
    Random random(cell);
    plain += kept(3, 0.3);
    const double threshold = draw(random);
    shared += kept(3, 0.3, threshold);
    CHECK(kept(3, 0, threshold) == 0);
    CHECK(kept(3, 1, threshold) == 3);
    CHECK(kept(3, 0.3, threshold) <= kept(3, 0.4, threshold));
  }
  CHECK(plain == 0);
  CHECK(static_cast<double>(shared) == Approx(9000).margin(150));  // three standard errors
}

}  // namespace manzana::foliage
