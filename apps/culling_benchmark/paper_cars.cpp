#include "apps/culling_benchmark/paper_cars.h"

#include <algorithm>

#include "apps/culling_benchmark/paper_colour.h"
#include "culling/hash.h"

namespace manzana::paper {
namespace {

/// Each a little off the lane's middle and height, so that of two cars in one place no two faces lie in one plane,
/// where the order of drawing would show.
CarInstance place(const CarState& car) {
  const Vec3d right(car.forward.y, -car.forward.x, 0);
  const Vec3d at = car.position + right * (0.4 * hash_unit(1, car.car) - 0.2);
  return {Vec3(at + Vec3d(0, 0, 0.05 * hash_unit(2, car.car))), pack(paint(car.car)), Vec2(car.forward)};
}

}  // namespace

std::size_t level_of(std::span<const CarLevel> levels, double radius_px) {
  std::size_t level = 0;
  while (level + 1 < levels.size() && radius_px < levels[level].min_radius_px) ++level;
  return level;
}

StreetFinder::StreetFinder(const baselines::City& city, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> position(city.objects());
  for (std::uint32_t i = 0; i < position.size(); ++i) position[order.empty() ? i : order[i]] = i;
  for (std::uint32_t b = 0; b < city.blocks.size(); ++b) entries_.push_back({position[street_row(city, b)], b});
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.position < b.position; });
}

void StreetFinder::find(std::span<const culling::ObjectRun> runs, std::vector<std::uint32_t>& blocks) const {
  blocks.clear();
  for (const culling::ObjectRun& run : runs) {
    auto at = std::lower_bound(entries_.begin(), entries_.end(), run.first,
                               [](const Entry& e, std::uint32_t position) { return e.position < position; });
    for (; at != entries_.end() && at->position < run.last; ++at) blocks.push_back(at->block);
  }
}

void attach_cars(const Traffic& traffic, std::span<const std::uint32_t> blocks, std::uint64_t tick, Attach attach,
                 SeenCars& seen) {
  seen.states.clear();
  if (attach == Attach::lazy) {
    for (const std::uint32_t block : blocks) cars_of_block(traffic, block, tick, seen.states);
    return;
  }
  seen.in_view.assign(traffic.block_first.size() - 1, 0);
  for (const std::uint32_t block : blocks) seen.in_view[block] = 1;
  for (std::uint32_t car = 0; car < traffic.cars(); ++car) {
    const CarState state = car_at(traffic, car, tick);
    if (seen.in_view[traffic.halves[state.half].block] != 0) seen.states.push_back(state);
  }
}

void choose_levels(std::span<const CarLevel> levels, const culling::View& view, int height, SeenCars& seen) {
  const double focal_px = height / (view.tan_top - view.tan_bottom);
  seen.count.assign(levels.size(), 0);
  seen.level.clear();
  seen.triangles = 0;
  for (const CarState& car : seen.states) {
    const double radius = culling::projected_radius(kCarRadius, glm::distance(car.position, view.eye), focal_px);
    seen.level.push_back(static_cast<std::uint8_t>(level_of(levels, radius)));
    ++seen.count[seen.level.back()];
    seen.triangles += levels[seen.level.back()].triangles;
  }
  std::array<std::uint32_t, kFiveLevels.size()> next{};
  for (std::size_t i = 1; i < seen.count.size(); ++i) next[i] = next[i - 1] + seen.count[i - 1];
  seen.instances.resize(seen.states.size());
  for (std::size_t i = 0; i < seen.states.size(); ++i) {
    seen.instances[next[seen.level[i]]++] = place(seen.states[i]);
  }
}

}  // namespace manzana::paper
