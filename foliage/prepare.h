#pragma once
/// From a plant to what is drawn of it at every distance. The parts: branch_levels.h, leaf_cloud.h, cell_visibility.h.
#include "foliage/prepared_plant.h"
#include "foliage/progress.h"

namespace manzana::foliage {

/// By what branches are more or less important. Width: the thickest first, so that no line is wider than need be. The
/// others: weighted-tree pruning by that measure (foliage/branch_tree.h), the source's way; area is projected area.
/// Width is the default: where lines are at most a pixel wide and the crown 128 px high, the ash of data/trees keeps 20
/// % of its triangles, by visible area 41 %, by length or count 75 to 100 %; and at a quarter of the triangles its
/// silhouette is off by 2.5 %, 3.4 %, and 4 to 6 % (64 px).
enum class BranchOrder : std::uint8_t { width, visible_area, area, length, count };

struct PrepareOptions {
  std::uint32_t quads_per_cell = 256;  ///< cells are split until they have no more
  std::uint32_t branch_levels = 6;     ///< meshes of branches, of all of them first; each next has half the triangles
  BranchOrder branch_order = BranchOrder::width;
  std::uint32_t visibility_side = 9;  ///< directions along each side of their grid; 0: visibility is not baked
  std::uint64_t seed = 1;
  Progress progress{};
};

/// The same for the same plant and options on every machine. Throws std::invalid_argument where check(plant) does.
PreparedPlant prepare(const Plant& plant, const PrepareOptions& options = {});

}  // namespace manzana::foliage
