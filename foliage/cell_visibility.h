#pragma once
/// How much of a cell of leaves can be seen from each side. [Gumbau 2009, section 4.2] The source asks the GPU four
/// times for each cell and view; here one picture of cell ids for each view, drawn on the CPU: the way without a GL,
/// and the oracle for those with one.
///   bake_visibility(plant, {.side = 9});
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

struct VisibilityOptions {
  std::uint32_t side = 9;  ///< of the octahedral grid of directions; at least 2, at most 257
  int pixels = 0;          ///< along each side of a picture; 0: for about 1000 a cell, 256 to 1024
};

/// Of each cell, seen by parallel rays: pixels that it would have alone, and those that it has among all cells and the
/// finest bark. Leaves have the holes of their picture.
struct CellPixels {
  std::vector<std::uint32_t> own, seen;
};
CellPixels cell_pixels(const PreparedPlant& plant, const Vec3d& to_eye, int pixels);

/// seen / own in 255ths, to the nearest but not to 0 unless it is. Without a pixel: 255 for a cell with leaves, 0 for
/// an empty one.
std::uint8_t seen_share(std::uint32_t seen, std::uint32_t own, bool empty);

/// Fills plant.visibility. Both vertices of a pair (foliage/octahedral.h) have the same shares. Deterministic. Cost: a
/// few seconds for 262 000 triangles at side 9, on all cores. Throws std::invalid_argument for options out of range.
void bake_visibility(PreparedPlant& plant, const VisibilityOptions& options = {});

}  // namespace manzana::foliage
