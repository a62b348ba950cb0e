#pragma once
/// Squares of different sizes side by side in pages.
#include <cstdint>
#include <span>
#include <vector>

namespace manzana::foliage {

/// A place in a page; x and y are whole multiples of the square's side.
struct PagePlace {
  std::uint32_t page = 0;
  std::uint16_t x = 0, y = 0;
};

/// For squares whose sides are powers of two up to that of a page: the larger first, along a Morton curve, so that
/// nothing overlaps, pages but the last are full, and mip levels of a page never mix two squares.
std::vector<PagePlace> pack_pages(std::span<const int> sides, int page_side);

}  // namespace manzana::foliage
