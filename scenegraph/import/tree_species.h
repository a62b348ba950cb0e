#pragma once
/// Which species stands where nothing says so, and how large its trees are.
///   tree.species = species_for(PlantKind::broadleaf, TreePlace::row, way_id);
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scenegraph/import/features.h"

namespace manzana {

/// Each has species of its own: those that are planted in rows, fruit trees in gardens.
enum class TreePlace : std::uint8_t { park, row, garden, wood };

/// Equal identities in like places are equal species: give the trees of a street, or of a row, the same.
PlantSpecies species_for(PlantKind kind, TreePlace place, std::uint64_t identity);

/// "Picea abies (L.)" -> "picea".
std::string genus_in(std::string_view name);
/// Of a botanical name, by its genus: one that is in no list is broadleaf; an empty name is nothing.
std::optional<PlantKind> kind_of_name(std::string_view name);
/// The nearest of ours to a botanical name, and nothing for an empty one.
std::optional<PlantSpecies> species_named(std::string_view name);

/// Of a genus in lower case; of those that are not here, nothing.
std::optional<PlantSpecies> species_of_genus(std::string_view genus);

/// Metres, and metres of the crown's radius a metre of height.
struct TreeHabit {
  double low, high, crown;
};
TreeHabit habit_of(PlantSpecies species);

/// Those that a scene has.
std::array<bool, kPlantSpecies> species_in(const Scene& scene);

/// One that stands free, so with a wide crown. `height`: of a plain tree of its kind.
TreeFeature free_tree(const Vec2d& at, double height, PlantSpecies species);

}  // namespace manzana
