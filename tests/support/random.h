#pragma once
/// Random numbers of tests: the same on every machine, and the seed is printed when a case fails.
#include <catch2/catch.hpp>
#include <cstdint>

namespace support {

class Random {
 public:
  explicit Random(std::uint64_t seed)
      : state_(seed),
        message_(Catch::MessageBuilder("info", CATCH_INTERNAL_LINEINFO, Catch::ResultWas::Info)
                 << "random seed " << seed) {}
  /// splitmix64
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ z >> 27) * 0x94d049bb133111ebULL;
    return z ^ z >> 31;
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double within(double low, double high) { return low + (high - low) * unit(); }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }

 private:
  std::uint64_t state_;
  Catch::ScopedMessage message_;
};

}  // namespace support
