#pragma once
/// Places in a buffer: [0, size), some taken, some free.
///   Ranges ranges;
///   ranges.grow(1000);
///   if (auto first = ranges.take(100)) ...; ranges.give(*first, 100);
#include <cstdint>
#include <map>
#include <optional>

namespace manzana::gl {

class Ranges {
 public:
  std::uint32_t size() const { return size_; }
  std::uint32_t taken() const { return taken_; }
  void grow(std::uint32_t size);  ///< not less than it is
  /// The first place with room for n, n > 0. Cost: logarithmic, and linear in the free places before it.
  std::optional<std::uint32_t> take(std::uint32_t n);
  /// What take(n) gave.
  void give(std::uint32_t first, std::uint32_t n);

 private:
  std::map<std::uint32_t, std::uint32_t> free_;  ///< first and number, none beside another
  std::uint32_t size_ = 0, taken_ = 0;
};

}  // namespace manzana::gl
