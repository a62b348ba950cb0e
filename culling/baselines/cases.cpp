#include "culling/baselines/cases.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "culling/baselines/town.h"

namespace manzana::baselines {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kC1 = 367'000, kC2 = 1'688'023;
constexpr std::uint32_t kPerBlock = 25;

constexpr std::array kCases{
    Case{"C1", "96 blocks, 367 000 triangles"},
    Case{"C2", "the same blocks, 1 688 023 triangles"},
    Case{"C3", "C2, and C1 beside it along x"},
    Case{"C4", "C2, and C1 beside it along y"},
    Case{"C5", "C2, and C1 beside it along the diagonal"},
    Case{"C6", "C2, and C1 beside it along x, y and the diagonal"},
    Case{"10k", "10 000 objects in 400 blocks"},
    Case{"100k", "100 000 objects in 4 000 blocks"},
    Case{"100k-1km", "the same, seen to 1 km", 1000},
    Case{"100k-cold", "the same, 96 MiB streamed between two queries", kFar, true},
    Case{"1M", "1 000 000 objects in 40 000 blocks"},
    Case{"1M-1km", "the same, seen to 1 km", 1000},
};

City paper_town(std::uint64_t triangles, std::uint64_t seed) {
  return grow_town({.blocks = 96, .columns = 12, .per_block = 31, .triangles = triangles}, seed);
}

void append(City& city, const City& more) {
  const std::uint32_t before = city.objects();
  city.blocks.insert(city.blocks.end(), more.blocks.begin(), more.blocks.end());
  city.boxes.insert(city.boxes.end(), more.boxes.begin(), more.boxes.end());
  city.kinds.insert(city.kinds.end(), more.kinds.begin(), more.kinds.end());
  city.triangles.insert(city.triangles.end(), more.triangles.begin(), more.triangles.end());
  for (std::size_t b = 1; b < more.first.size(); ++b) city.first.push_back(before + more.first[b]);
  city.bounds = merge(city.bounds, more.bounds);
}

/// Where C1 lies beside C2, in widths of it.
std::vector<Vec2d> neighbours(std::string_view name) {
  if (name == "C3") return {{1, 0}};
  if (name == "C4") return {{0, 1}};
  if (name == "C5") return {{1, 1}};
  if (name == "C6") return {{1, 0}, {0, 1}, {1, 1}};
  return {};
}

}  // namespace

std::span<const Case> cases() { return kCases; }

const Case* find_case(std::string_view name) {
  const auto* found = std::find_if(kCases.begin(), kCases.end(), [&](const Case& c) { return c.name == name; });
  return found == kCases.end() ? nullptr : found;
}

City make_city(const Case& which, std::uint64_t seed) {
  if (which.name.starts_with("10k")) return make_city(10'000, seed);
  if (which.name.starts_with("100k")) return make_city(100'000, seed);
  if (which.name.starts_with("1M")) return make_city(1'000'000, seed);
  const City c1 = paper_town(kC1, seed);
  if (which.name == "C1") return c1;
  City city = paper_town(kC2, seed);
  city.flown = city.bounds;
  const Vec3d size = city.bounds.max - city.bounds.min;
  for (const Vec2d& at : neighbours(which.name)) append(city, moved(c1, {at.x * size.x, at.y * size.y, 0}));
  return city;
}

City make_city(std::uint32_t objects, std::uint64_t seed) {
  const std::uint32_t blocks = std::max(1U, (objects + kPerBlock / 2) / kPerBlock);
  const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(blocks)));
  return grow_town(
      {.blocks = blocks, .columns = side, .per_block = kPerBlock, .triangles = std::uint64_t{blocks} * (kC2 / 96)},
      seed);
}

City moved(City city, const Vec3d& by) {
  const auto move = [&](culling::BoxD& box) { box = {box.min + by, box.max + by}; };
  for (culling::BlockVolume& block : city.blocks) {
    block.center += Vec2d(by);
    move(block.box);
    block.sphere = culling::enclosing_sphere(block.box);
  }
  std::for_each(city.boxes.begin(), city.boxes.end(), move);
  move(city.bounds);
  move(city.flown);
  return city;
}

}  // namespace manzana::baselines
