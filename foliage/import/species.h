#pragma once
/// Species presets: JSON with the names of SpeciesParams. Those of data/species are built in.
#include <array>
#include <string_view>

#include "foliage/generate.h"

namespace manzana::foliage {

/// The first three stand for all trees and shrubs of which no more is known.
inline constexpr std::array<std::string_view, 11> kSpeciesNames{
    "broadleaf", "conifer", "shrub", "oak", "birch", "poplar", "pine", "willow", "lime", "palm", "apple"};

/// Throws std::runtime_error naming the place (key) of what is wrong.
SpeciesParams parse_species(std::string_view json);
/// Both assert that it is one of them.
SpeciesParams builtin_species(std::string_view name);
std::string_view builtin_species_json(std::string_view name);

}  // namespace manzana::foliage
