#include "scenegraph/classes.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "scenegraph/scene.h"

namespace manzana {
namespace {

constexpr double kTallTree = 15;  // metres

constexpr std::array<std::pair<std::string_view, culling::ClassMask>, 12> kNames{
    {{"building", kBuildings},
     {"building10", kBuildingOver10 | kBuildingOver20 | kBuildingOver40},
     {"building20", kBuildingOver20 | kBuildingOver40},
     {"building40", kBuildingOver40},
     {"street", kSurface},
     {"tree", kTrees},
     {"tree15", kBroadleafOver15 | kConiferOver15},
     {"broadleaf", kTree | kBroadleafOver15},
     {"conifer", kConifer | kConiferOver15},
     {"shrub", kShrub},
     {"car", kCar},
     {"node", kNode}}};

}  // namespace

ObjectClass building_class(double height_m) {
  if (height_m >= 40) return kBuildingOver40;
  return height_m >= 20 ? kBuildingOver20 : height_m >= 10 ? kBuildingOver10 : kBuilding;
}

ObjectClass tree_class(PlantKind kind, double height_m) {
  if (kind == PlantKind::shrub) return kShrub;
  const bool tall = height_m >= kTallTree;
  if (kind == PlantKind::conifer) return tall ? kConiferOver15 : kConifer;
  return tall ? kBroadleafOver15 : kTree;
}

std::optional<culling::ClassMask> class_named(std::string_view name) {
  const auto found = std::ranges::find(kNames, name, [](const auto& entry) { return entry.first; });
  return found == kNames.end() ? std::nullopt : std::optional(found->second);
}

culling::ClassMask classes_named(std::string_view names) {
  culling::ClassMask all = 0;
  for (std::size_t at = 0; at < names.size();) {
    const std::size_t end = std::min(names.find_first_of(" ,", at), names.size());
    const std::string_view name = names.substr(at, end - at);
    const auto found = class_named(name);
    if (!found && !name.empty()) throw std::invalid_argument("no class is called '" + std::string(name) + "'");
    all |= found.value_or(0);
    at = end + 1;
  }
  return all;
}

}  // namespace manzana
