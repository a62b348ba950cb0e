#pragma once
/// What its neighbours hide of a tree, from every side: of what is hardly seen more may be wrong.
///   see_neighbours(sites, plants, rows);      // once, when all sites are known; then select() and extract() heed it
/// It is known before there is a camera, so nothing is read back from pictures, a turn of the head changes nothing, and
/// a step only a little. Nothing is ever left out for it.
#include <span>

#include "foliage/select.h"

namespace manzana::foliage {

/// Fills TreeSite::leeway. `block_rows`: three a block, relative to anywhere. About 0.2 ms for a tree of a closed
/// forest, on one core.
void see_neighbours(std::span<TreeSite> sites, std::span<const PreparedPlant> plants, std::span<const Vec4> block_rows);

/// The error of a tree of which so much is hidden, in [0, 1], may be 1 + this times as large. [Zhang 2004: s gamma,
/// s = 2]
double leeway(double hidden);

}  // namespace manzana::foliage
