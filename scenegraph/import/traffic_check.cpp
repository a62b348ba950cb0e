#include "scenegraph/import/traffic_check.h"

#include <algorithm>
#include <cmath>

namespace manzana {
namespace {

constexpr double kSampleSeconds = 0.1;
constexpr double kMarginLength = 0.4, kMarginWidth = 0.1;  // metres, in all
constexpr double kReach = 5.4;                             // metres: the diagonal of an enlarged car

bool touch_seen_from(const CarOutline& a, const CarOutline& b, double half_length, double half_width) {
  const Vec2d d = b.position - a.position;
  const double cosine = std::abs(glm::dot(a.forward, b.forward));
  const double sine = std::abs(a.forward.x * b.forward.y - a.forward.y * b.forward.x);
  return std::abs(glm::dot(d, a.forward)) < half_length + half_length * cosine + half_width * sine &&
         std::abs(a.forward.x * d.y - a.forward.y * d.x) < half_width + half_length * sine + half_width * cosine;
}

CarOutline outline(const CarState& car) {
  return {Vec2d(car.position), glm::normalize(Vec2d(car.forward)), car.position.z};
}

/// Sweeps along x.
template <class Meet>  // void(const CarState&, const CarState&)
void visit_touching(std::vector<CarState>& cars, Meet&& meet) {
  std::sort(cars.begin(), cars.end(), [](const CarState& a, const CarState& b) { return a.position.x < b.position.x; });
  for (std::size_t i = 0; i < cars.size(); ++i)
    for (std::size_t k = i + 1; k < cars.size() && cars[k].position.x < cars[i].position.x + kReach; ++k) {
      if (std::abs(cars[k].position.y - cars[i].position.y) > kReach) continue;
      if (touch(outline(cars[i]), outline(cars[k]), kMarginLength, kMarginWidth)) meet(cars[i], cars[k]);
    }
}

}  // namespace

bool touch(const CarOutline& a, const CarOutline& b, double more_length, double more_width) {
  const double length = (kCarLength + more_length) / 2, width = (kCarWidth + more_width) / 2;
  return std::abs(a.height - b.height) < kHeadroom && touch_seen_from(a, b, length, width) &&
         touch_seen_from(b, a, length, width);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> find_meetings(const Traffic& full, double cycle_s) {
  Traffic traffic = full;
  for (HalfStreet& half : traffic.halves) half.block = 0;
  index_blocks(traffic, 1);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  std::vector<CarState> cars;
  for (double t = 0; t < cycle_s; t += kSampleSeconds) {
    cars.clear();
    cars_of_block(traffic, 0, ticks(t), cars);
    visit_touching(cars,
                   [&](const CarState& a, const CarState& b) { found.emplace_back(std::minmax(a.half, b.half)); });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace manzana
