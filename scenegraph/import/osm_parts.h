#pragma once
/// Which building parts stand in which outline, and how much of it they cover.
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/import/features.h"

namespace manzana {

struct PartCover {
  std::vector<double> covered;            ///< a row an outline: share of its area under parts, 0 to 1
  std::vector<std::uint32_t> outline_of;  ///< a row a part: the outline that holds most of it, or kNoOutline
};
inline constexpr std::uint32_t kNoOutline = 0xffffffffu;

/// By GEOS, outlines that cross themselves mended first. Parts that reach into an outline by less than half of
/// themselves are not its parts. O((outlines + parts) log parts) and an overlay for each pair that comes near.
PartCover cover_by_parts(std::span<const Polygon> outlines, std::span<const Polygon> parts);

}  // namespace manzana
