#pragma once
/// Fewer triangles, by meshoptimizer.
#include "foliage/plant_mesh.h"

namespace manzana::foliage {

/// Vertices that are the same in every bit become one; unused ones go.
MeshPart welded(const MeshPart& part);

struct Reduced {
  MeshPart part;
  float error_m = 0;  ///< by meshoptimizer's measure, a root mean square: single points are up to twice as far
};

/// As few triangles as edge collapse can keep within `error_m` metres of the part.
Reduced simplified_within(const MeshPart& part, float error_m);

}  // namespace manzana::foliage
