#pragma once
/// Randomness that is the same on every machine and in any order: a counter hash of (seed, index). [numerics R6]
#include <cstdint>

namespace manzana {

/// splitmix64's finaliser over both words.
inline std::uint64_t hash_bits(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed * 0xd1342543de82ef95ULL + index * 0x9e3779b97f4a7c15ULL + 0x9e3779b97f4a7c15ULL;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ z >> 27) * 0x94d049bb133111ebULL;
  return z ^ z >> 31;
}

/// [0, 1)
inline double hash_unit(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(hash_bits(seed, index) >> 11) * 0x1p-53;
}

}  // namespace manzana
