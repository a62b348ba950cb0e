#pragma once
/// A scene of plants alone: an ecosystem on a meadow.
///   const auto meadow = foliage::read_ecosystem("meadow.json");
///   Imported scene = build_scene(ecosystem_features(meadow, plants), {}, progress);
#include <span>

#include "foliage/import/ecosystem.h"
#include "scenegraph/import/features.h"

namespace manzana {

inline constexpr std::uint64_t kMostScenePlants = 4'000'000;

/// Flattened: a scene's tree sorts plants by where they stand, whichever file placed them. `plants`: of
/// Ecosystem::plants, each with its size; they are numbered from kPlantSpecies on. Throws std::runtime_error where more
/// plants are placed, or more different ones, than a scene has room for.
CityFeatures ecosystem_features(const foliage::Ecosystem& ecosystem, std::span<const foliage::PreparedPlant> plants);

}  // namespace manzana
