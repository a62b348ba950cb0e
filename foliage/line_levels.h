#pragma once
/// Fewer lines for branches that are seen from farther: polylines lose points that nobody could miss, and of branches
/// much thinner than a pixel some stand for all. [Deussen 2005, section 10.3: q of the lines, each d' wide]
///   add_line_levels(plant, shapes, order, ready);   // after the finest lines
#include <span>

#include "foliage/branch_shape.h"
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

constexpr float kThinLine = 1.0F / 3;  ///< of an error: lines that are thinner become fewer and so wide

/// Of ten levels, each twice the one before: from 1/64 to 8 times so much.
std::vector<float> line_level_errors(float widest_m);

/// Fills line_levels, coarse_lines and, after the rows of the finest lines, line_firsts. `shapes`: of the plant's
/// branches; `order`: theirs in lines and meshes. Ten levels, of an error e that doubles, from 1/64 of the widest
/// branch to 8 times that:
///   - points go that are within e / 4 of the piece that is left, in place and in radius;
///   - of branches thinner than e / 3, on average, as many are left as cover the same when they are e / 3 wide.
/// Cost: linear.
void add_line_levels(const Plant& plant, std::span<const BranchShape> shapes, std::span<const std::uint32_t> order,
                     PreparedPlant& ready);

}  // namespace manzana::foliage
