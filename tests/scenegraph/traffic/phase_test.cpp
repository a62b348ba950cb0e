// Where a car is, against long double; any tick at once or step by step; motion without jumps.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iostream>

#include "culling/hash.h"
#include "towns.h"

using namespace manzana;
namespace {

constexpr std::uint64_t kHour = 3600 * std::uint64_t(kTicksPerSecond);

const Traffic& small_town() {
  static const Traffic traffic = traffic_of(grid_town(6, 6, 90, 12, 3, 5));
  return traffic;
}

const Circuit& circuit_of(const Traffic& traffic, std::uint32_t car) {
  for (const Circuit& c : traffic.circuits)
    if (car >= c.first_car && car < c.last_car) return c;
  throw std::logic_error("a car without a circuit");
}

/// Metres from the start of the half-street, by long double and a linear search: fmod of time, no phases.
struct Place {
  std::uint32_t half;
  long double s;
};
Place place_by_fmod(const Traffic& traffic, std::uint32_t car, std::uint64_t tick) {
  const Circuit& circuit = circuit_of(traffic, car);
  const long double period = circuit.period_s;
  const long double start = std::ldexp(static_cast<long double>(traffic.offsets[car]), -64) * period;
  long double t = std::fmod(start + static_cast<long double>(tick) / 3000.0L, period);
  std::uint32_t half = circuit.first_half;
  while (half + 1 < circuit.last_half && t >= static_cast<long double>(traffic.halves[half].duration_s))
    t -= static_cast<long double>(traffic.halves[half++].duration_s);
  const HalfStreet& h = traffic.halves[half];
  std::uint32_t piece = h.first_piece;
  while (piece + 1 < h.last_piece && static_cast<long double>(traffic.pieces[piece + 1].t0) <= t) ++piece;
  const MotionPiece& p = traffic.pieces[piece];
  const long double dt = t - static_cast<long double>(p.t0);
  return {half, p.s0 + p.v0 * dt + 0.5L * p.a * dt * dt};
}

Vec3d position(const Traffic& traffic, const Place& place) {
  const HalfStreet& h = traffic.halves[place.half];
  std::uint32_t i = h.first_point;
  while (i + 2 < h.last_point && traffic.points[i + 1].s <= double(place.s)) ++i;
  const LanePoint &a = traffic.points[i], &b = traffic.points[i + 1];
  return glm::mix(a.position, b.position, std::min(1.0, (double(place.s) - a.s) / (b.s - a.s)));
}

}  // namespace

TEST_CASE("cars are where long double says, up to 1000 h") {
  const Traffic& traffic = small_town();
  double worst = 0;
  for (const std::uint64_t hours : {0u, 1u, 10u, 100u, 1000u})
    for (std::uint32_t car = 0; car < traffic.cars(); ++car) {
      const std::uint64_t tick = hours * kHour + hash_bits(7, car) % kHour;
      const CarState state = car_at(traffic, car, tick);
      worst = std::max(worst, glm::distance(state.position, position(traffic, place_by_fmod(traffic, car, tick))));
    }
  std::cout << "largest error up to 1000 h: " << worst << " m\n";
  CHECK(worst < 1e-6);
}

TEST_CASE("seeking a tick is stepping to it, bit for bit") {
  const Traffic& traffic = small_town();
  for (const Circuit& circuit : traffic.circuits) {
    std::uint64_t whole = 0, fraction = 0;
    for (std::uint64_t tick = 0; tick < 200000; ++tick) {
      if (tick % 997 == 0) REQUIRE(phase_run(circuit, tick) == whole);
      fraction += circuit.step_fraction;
      whole += circuit.step + (fraction >> 32);
      fraction &= 0xffffffffu;
    }
  }
}

TEST_CASE("a lap is a whole number of ticks, to the bit's worth, after any time") {
  for (const Circuit& circuit : small_town().circuits) {
    const auto lap = static_cast<std::uint64_t>(std::llround(circuit.period_s * kTicksPerSecond));
    for (const std::uint64_t laps : {1u, 1000u, 1000000u}) {
      const auto off = static_cast<std::int64_t>(phase_run(circuit, lap * laps));
      CHECK(std::abs(std::ldexp(double(off), -64)) * circuit.period_s < 1e-9);
    }
  }
}

TEST_CASE("ticks") {
  CHECK(ticks(0) == 0);
  CHECK(ticks(-5) == 0);
  CHECK(ticks(std::nan("")) == 0);
  CHECK(ticks(1.0 / 60) == 50);
  CHECK(ticks(1e300) == std::uint64_t{1} << 62);
}

TEST_CASE("cars move without jumps, never backwards, along their heading") {
  const Traffic& traffic = small_town();
  double longest = 0, sharpest = 1;
  for (std::uint32_t car = 0; car < traffic.cars(); car += 5) {
    CarState last = car_at(traffic, car, 1000);
    for (std::uint64_t tick = 1030; tick < 400000; tick += 30) {
      const CarState state = car_at(traffic, car, tick);
      const Vec3d way = state.position - last.position;
      REQUIRE(glm::dot(way, last.forward) > 0);
      longest = std::max(longest, glm::length(way));
      sharpest = std::min(sharpest, glm::dot(state.forward, last.forward));
      REQUIRE(std::abs(glm::length(state.forward) - 1) < 1e-12);
      last = state;
    }
  }
  CHECK(longest < 0.01 * 14.01);
  CHECK(sharpest > std::cos(0.1));
}

TEST_CASE("pieces follow each other in position and speed, with mild accelerations") {
  const Traffic& traffic = small_town();
  for (const HalfStreet& h : traffic.halves) {
    double v_end = -1;
    for (std::uint32_t i = h.first_piece; i < h.last_piece; ++i) {
      const MotionPiece& p = traffic.pieces[i];
      const double t_end = i + 1 < h.last_piece ? double(traffic.pieces[i + 1].t0) : h.duration_s;
      const double dt = t_end - double(p.t0);
      REQUIRE(dt >= 0);
      if (v_end >= 0) REQUIRE(std::abs(double(p.v0) - v_end) < 1e-3);
      v_end = double(p.v0) + double(p.a) * dt;
      REQUIRE((double(p.v0) > 0.5 && v_end > 0.5));
      REQUIRE(std::abs(double(p.a)) < 2.5);
      const double s_end = double(p.s0) + double(p.v0) * dt + 0.5 * double(p.a) * dt * dt;
      const bool last = i + 1 == h.last_piece;
      REQUIRE(std::abs(s_end - (last ? traffic.points[h.last_point - 1].s : double(traffic.pieces[i + 1].s0))) < 1e-3);
    }
  }
}

TEST_CASE("time of car_at", "[time]") {
  const Traffic& traffic = small_town();
  double sum = 0;
  const std::clock_t begin = std::clock();
  constexpr std::uint32_t kCalls = 400000;
  for (std::uint32_t i = 0; i < kCalls; ++i) sum += car_at(traffic, i % traffic.cars(), i * 977).position.x;
  const double ns = double(std::clock() - begin) / CLOCKS_PER_SEC / kCalls * 1e9;
  std::cout << "car_at: " << ns << " ns (" << sum / kCalls << ")\n";
  CHECK(std::isfinite(sum));
}
