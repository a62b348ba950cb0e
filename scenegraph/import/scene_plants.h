#pragma once
/// Our own models of the species that a scene has.
///   const auto plants = scene_plants(scene, {.cache = foliage::default_cache_folder()}, show, tell);
#include "foliage/import/load_plant.h"
#include "scenegraph/import/import.h"

namespace manzana {

struct ScenePlants {
  std::uint64_t seed = 1;
  std::optional<std::filesystem::path> cache = {};  ///< where prepared plants are kept; none: they are not
};

/// By TreeInstance::plant; those that stand nowhere are empty. `tell` gets notes about what is kept.
std::vector<foliage::PreparedPlant> scene_plants(const Scene& scene, const ScenePlants& options,
                                                 const Progress& progress, const foliage::TellLine& tell);

}  // namespace manzana
