#include "foliage/ldm_pages.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace manzana::foliage {
namespace {

/// Every other bit.
std::uint16_t gathered(std::uint64_t bits) {
  std::uint16_t sum = 0;
  for (int i = 0; i < 16; ++i) sum = static_cast<std::uint16_t>(sum | ((bits >> (2 * i) & 1U) << i));
  return sum;
}

}  // namespace

std::vector<PagePlace> pack_pages(std::span<const int> sides, int page_side) {
  std::vector<std::size_t> order(sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sides[a] > sides[b]; });
  const auto area = static_cast<std::uint64_t>(page_side) * static_cast<std::uint64_t>(page_side);
  std::vector<PagePlace> places(sides.size());
  std::uint64_t used = 0;
  for (const std::size_t i : order) {
    assert(sides[i] > 0 && sides[i] <= page_side);
    const std::uint64_t in_page = used % area;
    places[i] = {static_cast<std::uint32_t>(used / area), gathered(in_page), gathered(in_page >> 1U)};
    used += static_cast<std::uint64_t>(sides[i]) * static_cast<std::uint64_t>(sides[i]);
  }
  return places;
}

}  // namespace manzana::foliage
