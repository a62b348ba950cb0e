#pragma once
/// Randomness by a counter hash (splitmix64's finaliser): the same on every machine and standard library.
#include <cstdint>

namespace manzana::foliage {

/// Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014.
constexpr std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}
constexpr std::uint64_t hash(std::uint64_t seed, std::uint64_t index) { return hash(hash(seed) ^ index); }

/// A stream of draws: value i is a hash of (seed, i).
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t bits() { return hash(seed_, counter_++); }
  float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24F; }  ///< [0, 1)
  float spread(float v) { return v * (2 * uniform() - 1); }                ///< [-v, v)

 private:
  std::uint64_t seed_, counter_ = 0;
};

}  // namespace manzana::foliage
