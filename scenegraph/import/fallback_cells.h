#pragma once
/// What stands in for blocks where there are no streets: an adaptive quadtree over the points themselves.
///   FallbackCells cells = fallback_cells(points, {.weight = 64, .size = 400});
///   cells.of[i] is the cell of the i-th point
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/import/centroid.h"

namespace manzana {

struct CellOptions {
  std::uint32_t weight = 64;  ///< points in a cell at most
  double size = 400;          ///< metres, longer side of a cell's points at most
  double smallest = 20;       ///< metres: a square smaller than twice that is not split, whatever its weight
};

struct FallbackCells {
  std::vector<PlanBox> cells;     ///< of the points in each; none is empty
  std::vector<std::uint32_t> of;  ///< a row a point
};

/// Each step splits the smallest square round a set's points (anchored at its lower left) into quadrants, half-open
/// towards the lower left; empty quadrants make no cell. So sides are at most `size`, weights at most `weight` except
/// in squares under 2 `smallest`. Independent of the points' order but for their numbers; cells come in Z order.
/// O(n log n) for spread points; coincident points end in one cell.
FallbackCells fallback_cells(std::span<const Vec2d> points, const CellOptions& options = {});

}  // namespace manzana
