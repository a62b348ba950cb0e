#pragma once
/// What a query can ask for. An object of the scene's tree is of one class, so "buildings over 20 m and conifers" is a
/// set of them, and a query for it (VisibleSets::classes) turns back where a part of the tree has none: nodes know the
/// classes of all that is below. [Pina 2009, future work: semantic culling]
///   sets.classes = classes_named("building20 conifer");
/// A host with other classes in mind (a species, "listed", an owner) gives its own: Nodes::classify.
#include <optional>
#include <string_view>

#include "culling/bqr_tree.h"

namespace manzana {

/// The first five are kinds, as features have them; where no more is known of an object it is of its kind's. A block
/// with half-streets has kCar among its own; a host's node is a kNode (scenegraph/nodes.h).
enum ObjectClass : culling::ClassMask {
  kBuilding = 1,  ///< under 10 m
  kSurface = 2,
  kTree = 4,  ///< broadleaf, under 15 m
  kCar = 8,
  kNode = 16,
  kBuildingOver10 = 32,
  kBuildingOver20 = 64,
  kBuildingOver40 = 128,
  kBroadleafOver15 = 256,
  kConifer = 512,  ///< under 15 m
  kConiferOver15 = 1024,
  kShrub = 2048,
};
inline constexpr culling::ClassMask kBuildings = kBuilding | kBuildingOver10 | kBuildingOver20 | kBuildingOver40;
inline constexpr culling::ClassMask kTrees = kTree | kBroadleafOver15 | kConifer | kConiferOver15 | kShrub;

/// Metres from its lowest to its highest point.
ObjectClass building_class(double height_m);
enum class PlantKind : std::uint8_t;
ObjectClass tree_class(PlantKind kind, double height_m);

/// building, building10, building20, building40, street (all that lies flat), tree, tree15, broadleaf, conifer, shrub,
/// car, node.
std::optional<culling::ClassMask> class_named(std::string_view name);
/// Several, separated by spaces or commas. Throws std::invalid_argument for a name that is none.
culling::ClassMask classes_named(std::string_view names);

}  // namespace manzana
