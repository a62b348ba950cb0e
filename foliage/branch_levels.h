#pragma once
/// Branches in nested levels: the most important ones as a mesh, the others as lines.
///   prepare_branches(plant, options, ready);              // fills bark, branch_levels, branch_steps, lines
///   BranchStep pair = branch_step(ready, level, 0.25F);   // a quarter of the way to the next level
///   draw(quads from ready.branch_levels[level].quads.first, pair.quads of them);
///   draw(ready.lines from pair.first_line to the end);
/// Branches turn into lines one by one, in one random order, so there is no switch from level to level: quads and lines
/// of all levels are in the same order of branches, in which those that the next level drops come last and are
/// shuffled. At t = 1 the lines are the next level's, and the mesh is its mesh unreduced.
#include "foliage/prepare.h"

namespace manzana::foliage {

void prepare_branches(const Plant& plant, const PrepareOptions& options, PreparedPlant& ready);

/// t in [0, 1]: 0 is the level, 1 the next one, or lines alone after the last. Clamped; NaN is 0. A level without steps
/// is always itself.
BranchStep branch_step(const PreparedPlant& plant, std::size_t level, float t);

}  // namespace manzana::foliage
