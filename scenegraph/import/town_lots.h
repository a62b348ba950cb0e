#pragma once
/// How a block of the built-in town is filled with houses and gardens.
#include <cstdint>
#include <vector>

#include "scenegraph/import/features.h"

namespace manzana {

enum class LotKind : std::uint8_t {
  perimeter,  ///< closed fronts round a court, shops and flats, now and then a tower
  rows,       ///< terraces with gaps and gables
  houses      ///< detached, with gardens
};

struct LotStyle {
  LotKind kind = LotKind::rows;
  int min_levels = 2, max_levels = 4;
  std::uint64_t seed = 0;
};

/// A ring with each edge k moved inwards by inset[k], metres; ring counter-clockwise. Empty when nothing is left.
std::vector<Vec2d> inset_ring(const std::vector<Vec2d>& ring, const std::vector<double>& inset);

/// Length along d, width across.
std::vector<Vec2d> rectangle(const Vec2d& center, const Vec2d& d, double length, double width);

/// Adds the buildings, the trees of the court or the gardens, and the ground. `ring` is convex, counter-clockwise:
/// where fronts may stand.
void fill_block(const std::vector<Vec2d>& ring, const LotStyle& style, CityFeatures& city);

}  // namespace manzana
