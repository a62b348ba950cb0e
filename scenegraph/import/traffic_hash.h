#pragma once
/// Random numbers by counter: the same on every machine, in any order.  [Steele, Lea, Flood, OOPSLA 2014: SplitMix64]
#include <cstdint>

namespace manzana {

inline std::uint64_t counter_hash(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed * 0xd1342543de82ef95u + (index + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}
/// In [0, 1).
inline double unit_hash(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(counter_hash(seed, index) >> 11) * 0x1p-53;
}

}  // namespace manzana
