#include "foliage/prepare.h"

#include "foliage/branch_levels.h"
#include "foliage/cell_visibility.h"
#include "foliage/fill_colour.h"
#include "foliage/leaf_cloud.h"

namespace manzana::foliage {

PreparedPlant prepare(const Plant& plant, const PrepareOptions& options) {
  const auto tell = [&](double done) {
    if (options.progress) options.progress(done);
  };
  check(plant);
  PreparedPlant ready;
  ready.name = plant.name;
  const PlantSize size = measure(plant.mesh);
  ready.height_m = size.height;
  ready.crown_radius_m = size.radius;
  ready.leaf_image = plant.leaf_image;
  ready.bark_image = plant.bark_image;
  tell(0);
  prepare_branches(plant, options, ready);
  tell(0.2);
  prepare_leaves(plant, options, ready);
  fill_unused(ready.leaf_image, ready.leaves);
  tell(0.6);
  if (options.visibility_side > 0 && !ready.cells.empty()) bake_visibility(ready, {.side = options.visibility_side});
  tell(1);
  return ready;
}

}  // namespace manzana::foliage
