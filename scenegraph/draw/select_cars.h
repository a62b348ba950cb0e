#pragma once
/// Which mesh each visible car is drawn with, and where. Cost: visible cars only.
///   CarSelection selection(scene.traffic.cars());
///   count_cars(sets.cars, view.eye, pixels, selection);        // chooses
///   place_cars(scene, sets.cars, view.eye, selection, slots);  // writes, sorted by body and level
#include <span>
#include <vector>

#include "scenegraph/draw/instances.h"
#include "scenegraph/scene.h"

namespace manzana::draw {

struct CarSelection {
  explicit CarSelection(std::size_t cars);
  InstanceBins bins;  ///< mesh of a body's level: body * kCarLevels + level
  struct Choice {
    std::uint8_t mesh = 0;
    float share = 1;  ///< of the samples that it covers, above 0; the others show the next level
  };
  std::vector<Choice> chosen;  ///< of each visible car
};

/// A car between two levels is two instances.
inline constexpr std::size_t most_instances(std::size_t cars) { return 2 * cars; }

/// `focal_px`: culling::projected_radius's, times the detail.
void count_cars(std::span<const CarState> cars, const Vec3d& eye, double focal_px, CarSelection& selection);
void place_cars(const Scene& scene, std::span<const CarState> cars, const Vec3d& eye, CarSelection& selection,
                Instance* slots);

/// Where a car stands: `up` is its block's. The fourth of its numbers is its share; of the other instance of a car
/// between two levels the same below 0, so that each sample belongs to one of them.
Instance place_car(const CarState& car, const Vec3d& up, const Vec3d& eye);

}  // namespace manzana::draw
