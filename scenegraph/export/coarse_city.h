#pragma once
/// Buildings and ground where so many metres may be wrong.
#include "scenegraph/export/tile_content.h"

namespace manzana {

/// Buildings not higher than error_m above the lowest of their block are shown together, as a slab that has their
/// volume. Of the others, a box stands for one whose corners are all within error_m of the building's vertices, and the
/// building's vertices within that of the box.
void append_coarse_buildings(TileContent& content, const Scene& scene, std::uint32_t block, const Placement& place,
                             double error_m);

/// Pieces smaller than a square of that side are left out, the others simplified within it.
void append_coarse_ground(TileMesh& mesh, const Scene& scene, std::uint32_t block, const Placement& place,
                          double error_m);

}  // namespace manzana
