#include "foliage/prepare.h"

#include "foliage/branch_levels.h"
#include "foliage/cell_visibility.h"
#include "foliage/grove_fit.h"
#include "foliage/leaf_cloud.h"

namespace manzana::foliage {

PreparedPlant prepare(const Plant& plant, const PrepareOptions& options) {
  check(plant);
  PreparedPlant ready;
  ready.name = plant.name;
  const PlantSize size = measure(plant.mesh);
  ready.height_m = size.height;
  ready.crown_radius_m = size.radius;
  ready.leaf_image = plant.leaf_image;
  ready.bark_image = plant.bark_image;
  const bool seen = options.visibility_side > 0;
  constexpr double kBranches = 0.05;
  const double leaves = seen ? 0.4 : 1;  // of the work is done with them
  tell(options.progress, 0);
  prepare_branches(plant, options, ready);
  tell(options.progress, kBranches);
  PrepareOptions for_leaves = options;
  for_leaves.progress = part_of(options.progress, kBranches, leaves);
  prepare_leaves(plant, for_leaves, ready);
  add_grove(ready);
  if (seen && !ready.cells.empty())
    bake_visibility(ready, {.side = options.visibility_side, .progress = part_of(options.progress, leaves, 1)});
  tell(options.progress, 1);
  return ready;
}

}  // namespace manzana::foliage
