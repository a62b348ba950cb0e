#pragma once
/// Places for squares in square pages, all sides powers of two: a page is quartered until a square fits, and four free
/// quarters are one again.
///   SquareRoom room(2048);
///   room.grow(1);
///   if (auto place = room.take(256)) ...; room.give(*place);
#include <compare>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace manzana::draw {

/// Texels of its page, from the lower left corner; x and y are multiples of the side.
struct Square {
  std::uint32_t page = 0, x = 0, y = 0, side = 1;
  auto operator<=>(const Square&) const = default;
};

class SquareRoom {
 public:
  /// `side`: a power of two.
  explicit SquareRoom(std::uint32_t side);
  std::uint32_t side() const { return side_; }
  std::uint32_t pages() const { return pages_; }
  void grow(std::uint32_t pages);  ///< not fewer than there are
  /// A power of two, at most side(). Logarithmic in the squares.
  std::optional<Square> take(std::uint32_t side);
  /// What take() gave.
  void give(Square square);

 private:
  std::set<Square>& free(std::uint32_t side);

  std::uint32_t side_, pages_ = 0;
  std::vector<std::set<Square>> free_;  ///< by the logarithm of their side
};

}  // namespace manzana::draw
