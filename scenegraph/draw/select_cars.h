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
  InstanceBins bins;                  ///< mesh of a body's level: body * kCarLevels + level
  std::vector<std::uint8_t> mesh_of;  ///< of each visible car
};

/// `focal_px`: culling::projected_radius's, times the detail.
void count_cars(std::span<const CarState> cars, const Vec3d& eye, double focal_px, CarSelection& selection);
void place_cars(const Scene& scene, std::span<const CarState> cars, const Vec3d& eye, CarSelection& selection,
                Instance* slots);

/// Where a car stands: `up` is its block's.
Instance place_car(const CarState& car, const Vec3d& up, const Vec3d& eye);

}  // namespace manzana::draw
