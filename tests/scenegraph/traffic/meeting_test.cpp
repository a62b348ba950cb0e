// Cars never touch: the outlines of all pairs of cars, at many times.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <unordered_map>

#include "culling/hash.h"
#include "towns.h"

using namespace manzana;
namespace {

constexpr double kLong = 4.5, kWide = 1.9;

bool apart_seen_from(const CarState& a, const CarState& b) {
  const Vec2d f = glm::normalize(Vec2d(a.forward)), g = glm::normalize(Vec2d(b.forward));
  const Vec2d d = Vec2d(b.position - a.position);
  const double cosine = std::abs(glm::dot(f, g)), sine = std::abs(f.x * g.y - f.y * g.x);
  return std::abs(glm::dot(d, f)) > (kLong + kLong * cosine + kWide * sine) / 2 ||
         std::abs(f.x * d.y - f.y * d.x) > (kWide + kLong * sine + kWide * cosine) / 2;
}
bool touch(const CarState& a, const CarState& b) {
  return std::abs(a.position.z - b.position.z) < 2 && !apart_seen_from(a, b) && !apart_seen_from(b, a);
}

std::int64_t cell(double x, double y) {
  return std::int64_t(std::floor(x / 6)) * 1000003 + std::int64_t(std::floor(y / 6));
}

/// Pairs that touch, by a hash of 6 m cells.
std::size_t touching(const std::vector<CarState>& cars) {
  std::unordered_multimap<std::int64_t, std::size_t> cells;
  std::size_t count = 0;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const auto [begin, end] = cells.equal_range(cell(cars[i].position.x + 6 * x, cars[i].position.y + 6 * y));
        for (auto k = begin; k != end; ++k) {
          if (!touch(cars[i], cars[k->second])) continue;
          if (++count <= 3)
            UNSCOPED_INFO("cars " << cars[i].car << " " << cars[k->second].car << " halves " << cars[i].half << " "
                                  << cars[k->second].half << " at " << cars[i].position.x << " " << cars[i].position.y
                                  << " and " << cars[k->second].position.x << " " << cars[k->second].position.y);
        }
      }
    cells.emplace(cell(cars[i].position.x, cars[i].position.y), i);
  }
  return count;
}

std::vector<CarState> all_cars(const Traffic& traffic, std::uint64_t tick) {
  std::vector<CarState> cars;
  for (std::uint32_t c = 0; c < traffic.cars(); ++c) cars.push_back(car_at(traffic, c, tick));
  return cars;
}

void check_never_touch(const Traffic& traffic, int times, std::uint64_t seed) {
  std::uint64_t tick = 0;
  for (int i = 0; i < times; ++i) {
    INFO("tick " << tick << " seed " << seed);
    REQUIRE(touching(all_cars(traffic, tick)) == 0);
    tick = i % 40 == 39 ? hash_bits(seed, std::uint64_t(i)) >> 20 : tick + 577;
  }
}

}  // namespace

TEST_CASE("cars of a town with a diagonal, one-way streets and dead ends never touch") {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const bool left : {false, true}) {
      const Traffic traffic = traffic_of(grid_town(11, 11, 100, 18, 4, seed), {.left_hand = left, .seed = seed});
      CAPTURE(seed, left, traffic.cars());
      CHECK(traffic.cars() > 500);
      check_never_touch(traffic, 200, seed);
    }
}

TEST_CASE("cars of wild street plans never touch, with as many cars as fit") {
  std::size_t half_streets = 0, cars = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Town town = wild_town(60, 700, seed);
    const Traffic traffic = traffic_of(town, {.cars = 1000000, .seed = seed});
    INFO("seed " << seed);
    half_streets += traffic.halves.size();
    cars += traffic.cars();
    check_never_touch(traffic, 150, seed);
  }
  std::cout << "30 wild plans: " << half_streets << " half-streets, " << cars << " cars\n";
  CHECK(cars > 30 * 50);
}
