#include "apps/common/quantile.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using manzana::apps::quantile;

TEST_CASE("quantile: the same as sorting and counting") {
  std::mt19937_64 bits(6);
  for (std::size_t n = 1; n < 60; ++n) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(static_cast<double>(bits() % 100));
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (const double p : {0.01, 0.5, 0.9, 0.99, 1.0}) {
      const double q = quantile(values, p);
      const auto reached = std::count_if(values.begin(), values.end(), [&](double v) { return v <= q; });
      const auto below = std::count_if(values.begin(), values.end(), [&](double v) { return v < q; });
      CHECK(static_cast<double>(reached) >= p * static_cast<double>(n));
      CHECK(static_cast<double>(below) < p * static_cast<double>(n));
    }
    CHECK(quantile(values, 1.0) == sorted.back());
  }
  CHECK(quantile({}, 0.5) == 0);
}
