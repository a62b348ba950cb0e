#include "apps/common/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/random.h"

using namespace manzana::apps;

TEST_CASE("median: the middle, or between the two in the middle") {
  CHECK(median({5}) == 5);
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 2, 3}) == 2.5);
}

TEST_CASE("median ratio: turned over, it is turned over") {
  support::Random random(1);
  for (std::size_t n = 1; n < 40; ++n) {
    std::vector<double> ratios, inverse;
    for (std::size_t i = 0; i < n; ++i) ratios.push_back(std::exp(random.within(-3, 3)));
    for (const double r : ratios) inverse.push_back(1 / r);
    CHECK(median_ratio(ratios) * median_ratio(inverse) == Approx(1));
  }
  CHECK(median_ratio({1, 4}) == Approx(2));
}

TEST_CASE("interval: the ends known from tables of order statistics") {
  const auto ends = [](int n) {
    std::vector<double> values;
    for (int i = n; i >= 1; --i) values.push_back(i);
    const Interval interval = median_interval(values);
    return std::pair{interval.low, interval.high};
  };
  CHECK(ends(1) == std::pair{1.0, 1.0});
  CHECK(ends(5) == std::pair{1.0, 5.0});
  CHECK(ends(6) == std::pair{1.0, 6.0});
  CHECK(ends(9) == std::pair{2.0, 8.0});
  CHECK(ends(20) == std::pair{6.0, 15.0});
  CHECK(ends(50) == std::pair{18.0, 33.0});
}

TEST_CASE("interval: holds the true median at least 95 times of 100, and is no wider than needed") {
  support::Random random(2);
  for (const std::size_t n : {6U, 9U, 15U, 50U}) {
    constexpr int kRounds = 4000;
    int held = 0;
    for (int round = 0; round < kRounds; ++round) {
      std::vector<double> values;
      for (std::size_t i = 0; i < n; ++i) values.push_back(std::exp(3 * random.unit()));  // skewed; its median: e^1.5
      const Interval interval = median_interval(values);
      held += interval.low <= std::exp(1.5) && std::exp(1.5) <= interval.high ? 1 : 0;
    }
    CAPTURE(n, held);
    CHECK(held > 0.94 * kRounds);  // 95 % less three standard deviations of this very test
    CHECK(held < 0.99 * kRounds);
  }
}

TEST_CASE("mean: within what tables of Student's t say") {
  const Mean mean = mean_of(std::array{1.0, 2.0, 3.0, 6.0});
  CHECK(mean.mean == 3);
  CHECK(mean.within == Approx(3.18245 * std::sqrt(14.0 / 3 / 4)).epsilon(1e-5));
  CHECK(std::isinf(mean_of(std::array{5.0}).within));
}
