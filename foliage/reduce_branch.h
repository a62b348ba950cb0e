#pragma once
/// Fewer triangles for one branch, of the same mean width.
#include <span>

#include "foliage/branch_shape.h"
#include "foliage/simplify.h"

namespace manzana::foliage {

/// A branch's triangles, with the vertices that they use.
MeshPart branch_part(const Plant& plant, const Branch& branch);

/// As few triangles as edge collapse keeps within `error_m` metres. A tube loses sides by that, and its sides lie
/// within the circle: so it is widened about `line` until it hides as much as before; the error told counts that too.
/// Where a fifth does not do, less is collapsed.
Reduced reduced_branch(const MeshPart& part, std::span<const CentrePoint> line, float error_m);

}  // namespace manzana::foliage
