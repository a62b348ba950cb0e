#pragma once
/// Species presets: JSON with the names of SpeciesParams. Three are built in: broadleaf, conifer, shrub (data/species).
#include <string_view>

#include "foliage/generate.h"

namespace manzana::foliage {

/// Throws std::runtime_error naming the place (key) of what is wrong.
SpeciesParams parse_species(std::string_view json);
SpeciesParams builtin_species(std::string_view name);  ///< asserts that it exists

}  // namespace manzana::foliage
