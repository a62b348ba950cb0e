#include "scenegraph/draw/select_cars.h"

#include "scenegraph/draw/car_model.h"

namespace manzana::draw {
namespace {

std::size_t level_of(double radius_px) {
  std::size_t level = 0;
  while (level + 1 < kCarLevels && radius_px < kCarMinRadiusPx[level]) ++level;
  return level;
}

CarSelection::Choice choose(CarBody body, double radius_px) {
  const std::size_t level = level_of(radius_px), first = static_cast<std::size_t>(body) * kCarLevels;
  if (level > 0) {
    const double high = kCarMinRadiusPx[level - 1], low = high / kCarFade;
    if (radius_px > low)
      return {static_cast<std::uint8_t>(first + level - 1), static_cast<float>((radius_px - low) / (high - low))};
  }
  return {static_cast<std::uint8_t>(first + level), 1};
}

}  // namespace

CarSelection::CarSelection(std::size_t cars) : bins(kCarBodies * kCarLevels) { chosen.reserve(cars); }

void count_cars(std::span<const CarState> cars, const Vec3d& eye, double focal_px, CarSelection& selection) {
  selection.bins.clear();
  selection.chosen.clear();
  for (const CarState& car : cars) {
    const double radius_px = culling::projected_radius(kCarRadius, glm::distance(car.position, eye), focal_px);
    const CarSelection::Choice chosen = choose(car_body(car.car), radius_px);
    selection.chosen.push_back(chosen);
    ++selection.bins.count[chosen.mesh];
    if (chosen.share < 1) ++selection.bins.count[chosen.mesh + 1U];
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
  instance.extra = Vec4(car_paint(car.car), 1);
  return instance;
}

void place_cars(const Scene& scene, std::span<const CarState> cars, const Vec3d& eye, CarSelection& selection,
                Instance* slots) {
  selection.bins.start();
  for (std::size_t i = 0; i < cars.size(); ++i) {
    const std::uint32_t block = scene.traffic.halves[cars[i].half].block;
    const CarSelection::Choice& chosen = selection.chosen[i];
    Instance instance = place_car(cars[i], scene.blocks[block].axes[2], eye);
    instance.extra.w = chosen.share;
    slots[selection.bins.next[chosen.mesh]++] = instance;
    if (chosen.share >= 1) continue;
    instance.extra.w = -chosen.share;
    slots[selection.bins.next[chosen.mesh + 1U]++] = instance;
  }
}

}  // namespace manzana::draw
