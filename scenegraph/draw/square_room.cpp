#include "scenegraph/draw/square_room.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace manzana::draw {
namespace {

std::array<Square, 4> quarters(const Square& s) {
  const std::uint32_t half = s.side / 2;
  return {{{s.page, s.x, s.y, half},
           {s.page, s.x + half, s.y, half},
           {s.page, s.x, s.y + half, half},
           {s.page, s.x + half, s.y + half, half}}};
}

}  // namespace

SquareRoom::SquareRoom(std::uint32_t side) : side_(side), free_(static_cast<std::size_t>(std::bit_width(side))) {
  assert(std::has_single_bit(side));
}

std::set<Square>& SquareRoom::free(std::uint32_t side) {
  return free_[static_cast<std::size_t>(std::countr_zero(side))];
}

void SquareRoom::grow(std::uint32_t pages) {
  for (; pages_ < pages; ++pages_) free(side_).insert({pages_, 0, 0, side_});
}

std::optional<Square> SquareRoom::take(std::uint32_t side) {
  assert(std::has_single_bit(side));
  std::uint32_t found = side;
  while (found <= side_ && free(found).empty()) found *= 2;
  if (found > side_) return {};
  Square square = *free(found).begin();
  free(found).erase(free(found).begin());
  while (square.side > side) {
    const auto parts = quarters(square);
    free(parts[0].side).insert(parts.begin() + 1, parts.end());
    square = parts[0];
  }
  return square;
}

void SquareRoom::give(Square square) {
  while (square.side < side_) {
    const std::uint32_t whole = 2 * square.side;
    const Square parent{square.page, square.x / whole * whole, square.y / whole * whole, whole};
    auto& same = free(square.side);
    const auto parts = quarters(parent);
    if (!std::ranges::all_of(parts, [&](const Square& s) { return s == square || same.contains(s); })) break;
    for (const Square& s : parts) same.erase(s);
    square = parent;
  }
  free(square.side).insert(square);
}

}  // namespace manzana::draw
