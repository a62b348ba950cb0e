#pragma once
/// Branches in nested levels: the most important ones as a mesh, the others as lines.
///   prepare_branches(plant, options, ready);   // fills bark, branch_levels, lines
#include "foliage/prepare.h"

namespace manzana::foliage {

void prepare_branches(const Plant& plant, const PrepareOptions& options, PreparedPlant& ready);

}  // namespace manzana::foliage
