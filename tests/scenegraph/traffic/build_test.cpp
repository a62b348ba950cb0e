// What build_traffic makes of street graphs: circuits, how many cars, and how long it takes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <ctime>
#include <iostream>

#include "towns.h"

using namespace manzana;
namespace {

Traffic timed(const Town& town, const TrafficOptions& options = {}) {
  const std::clock_t begin = std::clock();
  Traffic traffic = traffic_of(town, options);
  std::cout << town.graph.edges.size() << " streets, " << town.graph.junctions.size()
            << " junctions: " << traffic.halves.size() << " half-streets in " << traffic.circuits.size()
            << " circuits, " << traffic.cars() << " cars, " << 1000.0 * double(std::clock() - begin) / CLOCKS_PER_SEC
            << " ms CPU\n";
  return traffic;
}

/// Circuits are runs of half-streets that cover all; each half-street ends where the next begins, heading the same way.
void check_circuits(const Traffic& traffic) {
  std::uint32_t half = 0, car = 0;
  for (std::uint32_t c = 0; c < traffic.circuits.size(); ++c) {
    const Circuit& circuit = traffic.circuits[c];
    REQUIRE((circuit.first_half == half && circuit.first_car == car && circuit.last_half > half));
    double seconds = 0;
    for (half = circuit.first_half; half < circuit.last_half; ++half) {
      const std::uint32_t next = half + 1 < circuit.last_half ? half + 1 : circuit.first_half;
      const LanePoint& end = traffic.points[traffic.halves[half].last_point - 1];
      const LanePoint& begin = traffic.points[traffic.halves[next].first_point];
      REQUIRE(traffic.halves[half].circuit == c);
      REQUIRE(glm::distance(end.position, begin.position) < 2e-3);
      REQUIRE(glm::dot(end.forward, begin.forward) > 1 - 1e-6);
      seconds += traffic.halves[half].duration_s;
    }
    REQUIRE(std::abs(seconds - circuit.period_s) < 1e-6);
    car = circuit.last_car;
  }
  CHECK(half == traffic.halves.size());
  CHECK(car == traffic.cars());
  CHECK(std::is_sorted(traffic.halves.begin(), traffic.halves.end(),
                       [](const HalfStreet& a, const HalfStreet& b) { return a.circuit < b.circuit; }));
}

Town cross_roads() {
  TownMaker maker;
  for (const Vec3d& end : {Vec3d(120, 0, 0), Vec3d(0, 120, 0), Vec3d(-120, 0, 0), Vec3d(0, -120, 0)})
    maker.street({{0, 0, 0}, end});
  return maker.done();
}

/// The side of the street's middle that cars are on: +1 right of it as seen by the driver.
double side(const CarState& car, const Vec2d& middle) {
  const Vec2d d = Vec2d(car.position) - middle;
  return d.x * car.forward.y - d.y * car.forward.x;
}

}  // namespace

TEST_CASE("a town of 256 blocks takes 2000 cars and more") {
  const Town town = grid_town(17, 17, 100, 15, 0, 1);
  const Traffic traffic = timed(town);
  CHECK(traffic.cars() >= 2000);
  CHECK(traffic.halves.size() > 1.9 * double(town.graph.edges.size()));
  check_circuits(traffic);
}

TEST_CASE("a town of 216 blocks and 460 streets takes 2000 cars when asked to") {
  const Town town = grid_town(19, 13, 100, 15, 0, 2);
  CHECK(timed(town, {.cars = 2000}).cars() == 2000);
}

TEST_CASE("5000 streets", "[time]") {
  const Traffic traffic = timed(grid_town(50, 50, 100, 15, 4, 1));
  CHECK(traffic.cars() > 10000);
  check_circuits(traffic);
}

TEST_CASE("circuits are closed on wild plans") {
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    CAPTURE(seed);
    check_circuits(traffic_of(wild_town(80, 900, seed), {.seed = seed}));
  }
}

TEST_CASE("no streets, no junctions' worth of street, no cars, too many cars") {
  CHECK(traffic_of(TownMaker().done()).cars() == 0);
  CHECK(traffic_of(TownMaker().done()).block_first.size() == 2);
  TownMaker footpath;
  footpath.street({{0, 0, 0}, {100, 0, 0}}, false, 3, StreetClass::path);
  CHECK(traffic_of(footpath.done()).halves.empty());
  CHECK(traffic_of(cross_roads(), {.cars = 0}).cars() == 0);
  CHECK(!traffic_of(cross_roads(), {.cars = 0}).halves.empty());
  const auto most = traffic_of(cross_roads(), {.cars = 1 << 30}).cars();
  CHECK(most > 25);
  CHECK(most < 8 * 120 / 5);
  CHECK(traffic_of(cross_roads(), {.cars = 13}).cars() == 13);
}

TEST_CASE("a single street: there and back, on its right side or its left") {
  for (const bool left : {false, true}) {
    TownMaker maker;
    maker.street({{-100, 0, 0}, {100, 0, 0}});
    const Traffic traffic = traffic_of(maker.done(), {.left_hand = left});
    REQUIRE(traffic.halves.size() == 2);
    REQUIRE(traffic.cars() > 4);
    check_circuits(traffic);
    int checked = 0;
    for (std::uint32_t car = 0; car < traffic.cars(); ++car)
      for (std::uint64_t tick = 0; tick < 300000; tick += 3001) {
        const CarState state = car_at(traffic, car, tick);
        if (std::abs(state.position.x) > 90) continue;  // turning round
        REQUIRE(side(state, {state.position.x, 0}) * (left ? -1 : 1) == Approx(1.75).margin(0.01));
        ++checked;
      }
    CHECK(checked > 100);
  }
}

TEST_CASE("one-way streets: a ring is driven, a dead end is not") {
  TownMaker ring;
  const Vec3d corners[] = {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}};
  for (int i = 0; i < 4; ++i) ring.street({corners[i], corners[(i + 1) % 4]}, true);
  ring.street({corners[2], {200, 200, 0}}, true);  // leads nowhere
  const Traffic traffic = traffic_of(ring.done());
  CHECK(traffic.halves.size() == 4);
  CHECK(traffic.circuits.size() == 1);
  CHECK(traffic.cars() > 5);
  check_circuits(traffic);
  for (std::uint32_t car = 0; car < traffic.cars(); ++car) CHECK(car_at(traffic, car, 777).position.x < 110);
}

TEST_CASE("a one-way street between two-way streets is driven, or its way back is") {
  TownMaker maker;
  maker.street({{0, 0, 0}, {100, 0, 0}}, true);
  maker.street({{100, 0, 0}, {100, 80, 0}});
  maker.street({{100, 80, 0}, {0, 80, 0}});
  maker.street({{0, 80, 0}, {0, 0, 0}});
  const Traffic traffic = traffic_of(maker.done());
  CHECK(traffic.halves.size() == 6);  // shorter to give up the one-way street than the way round
  check_circuits(traffic);
}

TEST_CASE("cross-roads are crossed straight on where nothing speaks against it") {
  TownMaker maker;
  for (const Vec3d& end : {Vec3d(120, 0, 0), Vec3d(0, 120, 0), Vec3d(-120, 0, 0), Vec3d(0, -120, 0)})
    maker.street({{0, 0, 0}, end}, false, 7, StreetClass::residential);
  const Traffic traffic = traffic_of(maker.done(), {.cars = 12});
  CHECK(traffic.halves.size() == 8);
  CHECK(traffic.circuits.size() == 2);  // east and west, north and south: turning round at the dead ends
}

TEST_CASE("the same seed gives the same traffic, another seed other cars") {
  const Town town = grid_town(8, 8, 100, 15, 3, 4);
  const Traffic a = traffic_of(town, {.cars = 100, .seed = 1}), b = traffic_of(town, {.cars = 100, .seed = 1});
  const Traffic c = traffic_of(town, {.cars = 100, .seed = 2});
  CHECK((a.offsets == b.offsets));
  CHECK((a.offsets != c.offsets));
}
