#include "scenegraph/draw/select_cars.h"

#include "scenegraph/draw/car_model.h"

namespace manzana::draw {
namespace {

std::size_t level_of(double radius_px) {
  std::size_t level = 0;
  while (level + 1 < kCarLevels && radius_px < kCarMinRadiusPx[level]) ++level;
  return level;
}

}  // namespace

CarSelection::CarSelection(std::size_t cars) : bins(kCarBodies * kCarLevels) { mesh_of.reserve(cars); }

void count_cars(std::span<const CarState> cars, const Vec3d& eye, double focal_px, CarSelection& selection) {
  selection.bins.clear();
  selection.mesh_of.clear();
  for (const CarState& car : cars) {
    const double radius_px = culling::projected_radius(kCarRadius, glm::distance(car.position, eye), focal_px);
    const std::size_t mesh = static_cast<std::size_t>(car_body(car.car)) * kCarLevels + level_of(radius_px);
    selection.mesh_of.push_back(static_cast<std::uint8_t>(mesh));
    ++selection.bins.count[mesh];
  }
}

Instance place_car(const CarState& car, const Vec3d& up, const Vec3d& eye) {
  const Vec3d right = glm::normalize(glm::cross(car.forward, up));
  const Vec3d top = glm::cross(right, car.forward);
  const Vec3d at = car.position - eye;
  Instance instance;
  for (int i = 0; i < 3; ++i) {
    instance.rows[static_cast<std::size_t>(i)] = Vec4(glm::dvec4(right[i], car.forward[i], top[i], at[i]));
  }
  instance.extra = Vec4(car_paint(car.car), 0);
  return instance;
}

void place_cars(const Scene& scene, std::span<const CarState> cars, const Vec3d& eye, CarSelection& selection,
                Instance* slots) {
  selection.bins.start();
  for (std::size_t i = 0; i < cars.size(); ++i) {
    const std::uint32_t block = scene.traffic.halves[cars[i].half].block;
    slots[selection.bins.next[selection.mesh_of[i]]++] = place_car(cars[i], scene.blocks[block].axes[2], eye);
  }
}

}  // namespace manzana::draw
