#include "apps/culling_benchmark/paper_cars.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include "culling/baselines/cases.h"
#include "culling/baselines/exact.h"
#include "culling/baselines/peer.h"

namespace manzana::paper {
namespace {

using culling::BoxD;

constexpr double kRounding = 1e-9;  // metres: of a place between two others
constexpr double kNoFar = std::numeric_limits<double>::infinity();

baselines::City city(const char* name) { return baselines::make_city(*baselines::find_case(name), 1); }

bool within(const BoxD& inner, const BoxD& outer) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::lessThanEqual(inner.max, outer.max));
}

struct Streets {
  Streets(const baselines::City& before, std::uint32_t cars, std::uint64_t seed)
      : traffic(make_traffic(before, cars, seed)), city(with_streets(before, traffic)) {}
  Traffic traffic;
  baselines::City city;
};

BoxD round(const CarState& car, double radius) { return {car.position - radius, car.position + radius}; }

std::set<std::uint32_t> ids(const std::vector<CarState>& cars) {
  std::set<std::uint32_t> all;
  for (const CarState& car : cars) all.insert(car.car);
  return all;
}

/// Cars of which the exact answer says that a ball well within them is seen, and that are not in `found`.
std::size_t missed(const Streets& streets, const culling::View& view, std::uint64_t tick,
                   const std::set<std::uint32_t>& found, std::size_t& in_view) {
  const culling::ExactView exact = culling::make_exact(view);
  std::size_t lost = 0;
  for (std::uint32_t car = 0; car < streets.traffic.cars(); ++car) {
    if (!culling::exactly_overlaps(exact, round(car_at(streets.traffic, car, tick), 1))) continue;
    ++in_view;
    lost += 1 - found.count(car);
  }
  return lost;
}

}  // namespace

TEST_CASE("every car is on a half-street of its block, and the block encloses it") {
  const Streets streets(city("C2"), 2000, 7);
  CHECK(streets.traffic.cars() == 2000);
  for (const double seconds : {0.0, 3.3, 10.0, 1000.0}) {
    std::set<std::uint32_t> all;
    for (std::uint32_t b = 0; b < streets.city.blocks.size(); ++b) {
      std::vector<CarState> cars;
      cars_of_block(streets.traffic, b, ticks(seconds), cars);
      for (const CarState& car : cars) {
        CHECK(within(round(car, kCarRadius - kRounding), streets.city.boxes[street_row(streets.city, b)]));
        CHECK(within(round(car, kCarRadius - kRounding), streets.city.blocks[b].box));
        CHECK(all.insert(car.car).second);
      }
    }
    CHECK(all.size() == 2000);
  }
}

TEST_CASE("streets add no triangles, and blocks enclose all they did") {
  const baselines::City before = city("C6");
  const Streets streets(before, 100, 1);
  REQUIRE(streets.city.blocks.size() == before.blocks.size());
  CHECK(streets.city.objects() == before.objects() + before.blocks.size());
  for (std::uint32_t b = 0; b < before.blocks.size(); ++b) {
    CHECK(within(before.blocks[b].box, streets.city.blocks[b].box));
    CHECK(streets.city.triangles[street_row(streets.city, b)] == 0);
    CHECK(streets.city.blocks[b].center == before.blocks[b].center);
  }
}

TEST_CASE("cars keep their speed, and some come to other blocks") {
  const Streets streets(city("C2"), 500, 3);
  const auto block = [&](const CarState& car) { return streets.traffic.halves[car.half].block; };
  constexpr double kStep = 0.5;
  int moved = 0, turned = 0;
  for (std::uint32_t car = 0; car < 500; ++car) {
    for (int i = 0; i < 20; ++i) {
      const CarState a = car_at(streets.traffic, car, ticks(i * kStep));
      const CarState b = car_at(streets.traffic, car, ticks((i + 1) * kStep));
      const double way = glm::distance(a.position, b.position);
      CHECK(way <= kCarSpeed * kStep * 1.001);
      CHECK(way > kCarSpeed * kStep * 0.8);  // across a corner that is cut
      moved += block(a) != block(b) ? 1 : 0;
      turned += glm::dot(a.forward, b.forward) < 0.5 ? 1 : 0;
    }
  }
  CHECK(moved > 50);
  CHECK(turned > 50);
}

TEST_CASE("eager and lazy attachment give the same cars, and none in view is missed") {
  const Streets streets(city("C2"), 1000, 5);
  std::vector<std::uint32_t> blocks;
  SeenCars lazy, eager;
  baselines::Answer answer;
  for (const char* slug : {"none", "bqr", "bqr-paper", "vam-block8", "vam-block6", "vam-block1"}) {
    const auto* info = baselines::find_peer(slug);
    if (info == nullptr || !info->available) continue;
    const auto peer = info->make(streets.city);
    const StreetFinder finder(streets.city, peer->order());
    std::size_t in_view = 0;
    for (int i = 0; i < 12; ++i) {
      INFO(slug << ", frame " << i);
      const culling::View view = baselines::flight(streets.city, kNoFar, i / 11.0);
      peer->query(culling::make_frustum(view), answer);
      finder.find(answer.runs, blocks);
      const std::uint64_t tick = ticks(i * 0.7);
      attach_cars(streets.traffic, blocks, tick, Attach::lazy, lazy);
      attach_cars(streets.traffic, blocks, tick, Attach::eager, eager);
      CHECK(lazy.states.size() == eager.states.size());
      CHECK(ids(lazy.states) == ids(eager.states));
      CHECK(missed(streets, view, tick, ids(lazy.states), in_view) == 0);
    }
    CHECK(in_view > 500);
  }
}

TEST_CASE("a car's level is the finest that its size in the picture allows") {
  std::size_t before = 0;
  for (double radius = 1000; radius > 0.1; radius *= 0.97) {
    const std::size_t level = level_of(kFiveLevels, radius);
    CHECK(level >= before);
    CHECK((level == 0 || radius < kFiveLevels[level - 1].min_radius_px));
    CHECK(radius >= kFiveLevels[level].min_radius_px);
    before = level;
  }
  CHECK(before == kFiveLevels.size() - 1);
  CHECK(level_of(kOneLevel, 0.01) == 0);
  CHECK(level_of(kFiveLevels, std::numeric_limits<double>::infinity()) == 0);
}

TEST_CASE("cars are sorted by level, the nearest first") {
  const Streets streets(city("C2"), 1000, 5);
  std::vector<std::uint32_t> all(streets.city.blocks.size());
  std::iota(all.begin(), all.end(), 0U);
  SeenCars seen;
  attach_cars(streets.traffic, all, 0, Attach::lazy, seen);
  const culling::View view = baselines::flight(streets.city, kNoFar, 0.3);
  choose_levels(kFiveLevels, view, 720, seen);
  REQUIRE(seen.instances.size() == 1000);
  double farthest = 0;
  std::size_t i = 0;
  std::uint64_t triangles = 0;
  for (std::size_t level = 0; level < seen.count.size(); ++level) {
    const double nearest = farthest - 1;  // a metre: instances stand a little off their lane
    for (const std::size_t end = i + seen.count[level]; i < end; ++i) {
      const double distance = glm::distance(Vec3d(seen.instances[i].position), view.eye);
      CHECK(distance > nearest);
      farthest = std::max(farthest, distance);
      triangles += kFiveLevels[level].triangles;
    }
    CHECK((level == 0 || seen.count[level] > 0));
  }
  CHECK(i == 1000);
  CHECK(seen.triangles == triangles);
}

}  // namespace manzana::paper
