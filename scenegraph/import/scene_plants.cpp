#include "scenegraph/import/scene_plants.h"

#include "foliage/import/species.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {

std::vector<foliage::PreparedPlant> scene_plants(const Scene& scene, const ScenePlants& options,
                                                 const Progress& progress, const foliage::TellLine& tell) {
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  const auto stands = species_in(scene);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    if (!stands[i]) continue;
    foliage::PrepareOptions how;
    how.visibility_side = 0;
    how.progress = [&](double done) {
      if (progress) progress("plants", (static_cast<double>(i) + done) / static_cast<double>(plants.size()));
    };
    plants[i] = foliage::grow_or_prepare(foliage::kSpeciesNames[i], options.seed, options.cache, how, tell);
  }
  return plants;
}

}  // namespace manzana
