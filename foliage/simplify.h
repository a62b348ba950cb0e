#pragma once
/// Fewer triangles, by meshoptimizer.
#include "foliage/plant_mesh.h"

namespace manzana::foliage {

/// Vertices that are the same in every bit become one; unused ones go.
MeshPart welded(const MeshPart& part);

/// About `triangles`, by edge collapse; by merging cells where that stops short of it (it keeps topology, so it stops
/// early on cards and tubes).
MeshPart simplified(const MeshPart& part, std::size_t triangles);

struct Reduced {
  MeshPart part;
  float error_m = 0;  ///< by meshoptimizer's measure, a root mean square: single points are up to twice as far
};

/// As few triangles as edge collapse can keep within `error_m` metres of the part.
Reduced simplified_within(const MeshPart& part, float error_m);

/// Only the piece (joined by places, not by vertices) with the most area: the trunk, in a model of separate tubes.
MeshPart largest_piece(const MeshPart& part);

}  // namespace manzana::foliage
