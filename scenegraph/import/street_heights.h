#pragma once
/// The profile of the streets: bridges over something are lifted, the rest falls from them.
#include "scenegraph/import/street_graph.h"

namespace manzana {

/// Sets the heights of all points and junctions, metres above ground, and adds points where the profile bends, at most
/// 10 m apart on slopes (1/200 of an edge where that is more).
/// A bridge is level at kBridgeRise * layer over what it crosses, and between such crossings along bridges joined to
/// it; from there everything falls by kRampGrade along the streets, to the ground. Other bridges arch gently: 1.5 m, or
/// 1/15 of their length where that is less, from end to end of the bridges joined to each other.
/// O(n log n).
void raise_streets(StreetGraph& graph);

}  // namespace manzana
