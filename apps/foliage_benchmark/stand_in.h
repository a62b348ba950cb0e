#pragma once
/// Plants of our own in place of the sources'.
#include <algorithm>
#include <cmath>

#include "foliage/generate.h"
#include "foliage/import/species.h"

namespace manzana::foliage_benchmark {

/// A species with as many leaves a stem as come nearest to so many triangles of leaves.
inline foliage::Plant grown_to(std::string_view species_name, double leaf_triangles) {
  foliage::SpeciesParams species = foliage::builtin_species(species_name);
  const auto by_nature = static_cast<double>(grow_plant(species, 1).mesh.leaves.triangles());
  species.leaves = std::max(1, static_cast<int>(std::lround(species.leaves * leaf_triangles / by_nature)));
  return grow_plant(species, 1);
}

/// A species whose cards, of many leaves each, are smaller and more, so that it has about so many triangles in all and
/// its leaves the same area.
foliage::Plant grown_dense(std::string_view species_name, double triangles);

}  // namespace manzana::foliage_benchmark
