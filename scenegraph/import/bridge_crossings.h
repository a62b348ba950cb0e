#pragma once
/// Where bridges pass over something: pairs of edges that meet in plan without meeting at a junction.
#include <vector>

#include "scenegraph/import/street_graph.h"

namespace manzana {

/// 0 for what lies on the ground; a bridge is at least on layer 1, at most on 5 (the OSM wiki's range).
int deck_layer(const StreetFeature& street);

/// The stretch of an edge, metres in plan from its start, that lies over lower streets. Empty when s0 > s1.
struct Span {
  double s0 = 1, s1 = 0;
  bool empty() const { return !(s0 <= s1); }
};

/// A row an edge; empty except for bridges over something on a lower layer: from the first to the last such crossing,
/// with the width of what is crossed. Touching counts, except at a junction that both have.
/// O((n + crossings) log n) by an STR-tree of the bridges' segments.
std::vector<Span> spans_over_streets(const StreetGraph& graph);

}  // namespace manzana
