#include "apps/culling_benchmark/goals.h"

#include <array>

namespace manzana::culling_benchmark {
namespace {

constexpr std::array kGoals{
    Goal{"C2", "linear-simd", .25},
    Goal{"10k", "linear-simd", .20},
    Goal{"100k", "linear-simd", .06},
    Goal{"1M-1km", "linear-simd", .009},
    Goal{"C2", "vam16", .10},
    Goal{"10k", "vam16", .10},
    Goal{"100k", "vam16", .09},
    Goal{"1M-1km", "vam16", .13},
    Goal{"C2", "bvh8", .55},
    Goal{"10k", "bvh8", .50},
    Goal{"100k", "bvh8", .40},
    Goal{"1M-1km", "bvh8", .43},
    Goal{"100k-cold", "bvh8", .55},
    Goal{"C2", "boost-frustum", .10},
    Goal{"10k", "boost-frustum", .07},
    Goal{"100k", "boost-frustum", .03},
    Goal{"1M-1km", "boost-frustum", .12},
    Goal{"C2", "osg", .010},
    Goal{"10k", "osg", .006},
    Goal{"100k", "osg", .0015},
    Goal{"1M-1km", "osg", .010},
};

constexpr std::array<std::string_view, 5> kCases{"C2", "10k", "100k", "1M", "1M-1km"};
constexpr std::array<double, 5> kLinearSimd{1.8, 4.5, 48, 523, 461};
struct KnownRow {
  std::string_view peer, grain;
  std::array<double, 5> us;
};
constexpr std::array kKnownRows{
    KnownRow{"linear", "object", {12.7, 52, 1174, 12174, 12148}},
    KnownRow{"vam16", "object", {4.8, 9.3, 33, 131, 32}},
    KnownRow{"bqr-paper", "block", {.57, 1.3, 6.4, 47, 5.5}},
    KnownRow{"bqr-paper", "object", {4.2, 9.6, 37, 343, 59}},
    KnownRow{"bvh8", "object", {.82, 1.7, 6.9, 44, 9.8}},
    KnownRow{"boost-frustum", "object", {4.7, 13, 107, 983, 34}},
    KnownRow{"osg-stack", "object", {14, 33, 447, 17770, 174}},
    KnownRow{"osg", "object", {48, 147, 2083, 32741, 427}},
};

constexpr auto make_known() {
  std::array<Known, kKnownRows.size() * kCases.size()> all{};
  for (std::size_t r = 0; r < kKnownRows.size(); ++r)
    for (std::size_t c = 0; c < kCases.size(); ++c)
      all[r * kCases.size() + c] = {kCases[c], kKnownRows[r].peer, kKnownRows[r].grain, kKnownRows[r].us[c],
                                    kLinearSimd[c]};
  return all;
}
constexpr auto kKnown = make_known();

}  // namespace

std::span<const Goal> goals() { return kGoals; }
std::span<const Known> known_rivals() { return kKnown; }

}  // namespace manzana::culling_benchmark
