#include "scenegraph/import/ecosystem_features.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace manzana {
namespace {

void check_room(const foliage::Ecosystem& ecosystem) {
  const foliage::EcosystemNode& root = ecosystem.nodes.back();
  if (root.placed > kMostScenePlants)
    throw std::runtime_error(root.file + ": places " + std::to_string(root.placed) + " plants; a scene has room for " +
                             std::to_string(kMostScenePlants));
  if (ecosystem.plants.size() > std::numeric_limits<std::uint16_t>::max() - kPlantSpecies)
    throw std::runtime_error(root.file + ": too many different plants");
}

PlacedPlant placed(const foliage::Placement& at, const foliage::PreparedPlant& plant, std::uint32_t number) {
  return {.position = at.position,
          .height = at.scale * static_cast<double>(plant.height_m),
          .crown_radius = at.scale * static_cast<double>(plant.crown_radius_m),
          .yaw = std::remainder(at.turn, 2 * std::numbers::pi),
          .plant = static_cast<std::uint16_t>(kPlantSpecies + number)};
}

/// A disk that goes a little beyond all plants.
AreaFeature meadow_under(std::span<const PlacedPlant> plants) {
  constexpr int kCorners = 48;
  constexpr double kBeyond = 1.25, kLeast = 3;  // metres
  Vec2d low(0), high(0);
  for (const PlacedPlant& plant : plants) {
    low = glm::min(low, Vec2d(plant.position));
    high = glm::max(high, Vec2d(plant.position));
  }
  const Vec2d middle = low + (high - low) / 2.0;
  const double radius = std::max(kLeast, kBeyond * glm::length(high - low) / 2);
  AreaFeature meadow{.where = "the ecosystem's ground", .shape = {}, .kind = Material::grass};
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    meadow.shape.outer.push_back(middle + radius * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return meadow;
}

}  // namespace

CityFeatures ecosystem_features(const foliage::Ecosystem& ecosystem, std::span<const foliage::PreparedPlant> plants) {
  check_room(ecosystem);
  CityFeatures features;
  each_plant(
      ecosystem, [](std::uint32_t, const foliage::Placement&) { return true; },
      [&](std::uint32_t plant, const foliage::Placement& at) {
        features.plants.push_back(placed(at, plants[plant], plant));
      });
  features.areas.push_back(meadow_under(features.plants));
  return features;
}

}  // namespace manzana
