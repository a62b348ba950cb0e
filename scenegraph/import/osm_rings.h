#pragma once
/// Rings from the member ways of a multipolygon relation, and holes to the outer rings that hold them.
#include "scenegraph/import/osm_shapes.h"

namespace manzana {

struct MemberWay {
  OsmLine line;
  bool closed = false;
};
struct MemberWays {
  std::vector<MemberWay> outer, inner;
};

/// One polygon an outer ring. Ways are joined where they end at the same node. What does not close, has no area, or
/// lies outside every outer ring is listed and left out. Takes O(ways + holes * outer corners).
std::vector<Polygon> assemble_rings(MemberWays& members, const std::string& where, std::vector<Issue>& issues);

/// Drops corners that repeat the one before, and the last where it is the first again.
void clean_ring(std::vector<Vec2d>& ring);
/// Some corner lies off the straight line through two others by more than a centimetre. Bow-ties of no area have width.
bool has_width(std::span<const Vec2d> ring);

}  // namespace manzana
