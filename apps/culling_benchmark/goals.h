#pragma once
/// What the BqR-Tree is meant to reach, and what its rivals are known to reach: fixed figures that a report holds its
/// own against.
#include <span>
#include <string_view>

namespace manzana::culling_benchmark {

/// bqr's time over the peer's is meant to be at most that.
struct Goal {
  std::string_view case_name, peer;
  double most;
};
std::span<const Goal> goals();

/// bqr's accepted objects over the exact ones.
inline constexpr double kMostAccepted = 1.001;
/// bqr's time from 100 000 to 1 000 000 objects, both seen to 1 km.
inline constexpr double kMostGrowth = 1.4;

/// What a rival took in another program that measured it, microseconds, beside linear-simd in the same program: no
/// figure about bqr counts that rests on a rival much slower than it can be.
struct Known {
  std::string_view case_name, peer, grain;
  double us, linear_simd_us;
};
std::span<const Known> known_rivals();
inline constexpr double kSlowest = 1.3;  ///< times that ratio

}  // namespace manzana::culling_benchmark
