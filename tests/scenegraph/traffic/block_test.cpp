// The cars of a block, found by bisection, are those that a look at every single car finds. [numerics 8.2]
#include <algorithm>
#include <catch2/catch.hpp>
#include <iostream>

#include "culling/hash.h"
#include "towns.h"

using namespace manzana;
namespace {

bool same(const CarState& a, const CarState& b) {
  return a.car == b.car && a.half == b.half && a.position == b.position && a.forward == b.forward;
}
void sort_by_car(std::vector<CarState>& cars) {
  std::sort(cars.begin(), cars.end(), [](const CarState& a, const CarState& b) { return a.car < b.car; });
}

/// Every car by car_at, dealt to its half-street's block, against cars_of_block for every block.
void check_blocks(const Traffic& traffic, std::uint64_t tick) {
  std::vector<std::vector<CarState>> eager(traffic.block_first.size() - 1);
  for (std::uint32_t car = 0; car < traffic.cars(); ++car) {
    const CarState state = car_at(traffic, car, tick);
    eager[traffic.halves[state.half].block].push_back(state);
  }
  std::vector<CarState> lazy;
  for (std::uint32_t block = 0; block < eager.size(); ++block) {
    lazy.clear();
    cars_of_block(traffic, block, tick, lazy);
    sort_by_car(lazy);
    REQUIRE(lazy.size() == eager[block].size());
    REQUIRE(std::equal(lazy.begin(), lazy.end(), eager[block].begin(), same));
  }
}

}  // namespace

TEST_CASE("lazy is eager: every block, 10 000 cars, running and teleporting through time") {
  const Town town = grid_town(40, 40, 90, 12, 5, 11);
  const Traffic traffic = traffic_of(town, {.cars = 10000});
  std::cout << "lazy = eager with " << traffic.cars() << " cars in " << town.blocks << " blocks\n";
  CHECK(traffic.cars() > 9000);
  for (const std::uint64_t tick : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 40, ~std::uint64_t{0}})
    check_blocks(traffic, tick);
  for (std::uint64_t frame = 0; frame < 300; ++frame) check_blocks(traffic, frame * 50);
  for (std::uint64_t i = 0; i < 300; ++i) check_blocks(traffic, hash_bits(21, i) >> (i % 50));
}

TEST_CASE("lazy is eager on wild plans and when a circuit is one half-street") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Traffic traffic = traffic_of(wild_town(40, 600, seed), {.cars = 100000, .seed = seed});
    for (std::uint64_t i = 0; i < 360; ++i) check_blocks(traffic, i % 2 ? i * 50 : hash_bits(seed, i));
  }
  TownMaker maker;
  maker.street({{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}, {0, 0, 0}}, true);
  const Traffic ring = traffic_of(maker.done());
  REQUIRE(ring.halves.size() == 1);
  REQUIRE(ring.cars() > 5);
  for (std::uint64_t i = 0; i < 360; ++i) check_blocks(ring, hash_bits(3, i));
}

TEST_CASE("cars of a block stay within its half-streets' bounds") {
  const Traffic traffic = traffic_of(grid_town(6, 6, 90, 12, 3, 5));
  for (std::uint64_t i = 0; i < 200; ++i)
    for (std::uint32_t car = 0; car < traffic.cars(); ++car) {
      const CarState state = car_at(traffic, car, hash_bits(31, i));
      const culling::BoxD box = half_street_bounds(traffic, state.half);
      const Vec3d nose = state.position + state.forward * 2.3;
      for (const Vec3d& p : {state.position, nose})
        REQUIRE((glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max))));
    }
}

TEST_CASE("blocks renumbered: the same cars under new numbers") {
  const Town town = grid_town(6, 6, 90, 12, 3, 5);
  const Traffic before = traffic_of(town);
  Traffic after = before;
  std::vector<std::uint32_t> new_of_old(town.blocks);
  for (std::uint32_t b = 0; b < town.blocks; ++b) new_of_old[b] = (b * 7 + 3) % town.blocks;  // 25 blocks
  reorder_blocks(after, new_of_old);
  for (std::uint32_t b = 0; b < town.blocks; ++b) {
    std::vector<CarState> old_cars, new_cars;
    cars_of_block(before, b, 12345, old_cars);
    cars_of_block(after, new_of_old[b], 12345, new_cars);
    REQUIRE(old_cars.size() == new_cars.size());
    REQUIRE(std::equal(old_cars.begin(), old_cars.end(), new_cars.begin(), same));
  }
  check_blocks(after, 999);
}
