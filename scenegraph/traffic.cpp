#include "scenegraph/traffic.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace manzana {
namespace {

/// Metres from the half-street's start after `time` seconds on it.
double distance_after(const Traffic& traffic, const HalfStreet& half, double time) {
  const auto begin = traffic.pieces.begin() + half.first_piece, end = traffic.pieces.begin() + half.last_piece;
  const auto after =
      std::upper_bound(begin + 1, end, time, [](double t, const MotionPiece& p) { return t < double(p.t0); });
  const MotionPiece& piece = *(after - 1);
  const double dt = time - double(piece.t0);
  return double(piece.s0) + (double(piece.v0) + 0.5 * double(piece.a) * dt) * dt;
}

CarState state_on(const Traffic& traffic, std::uint32_t half_id, std::uint64_t phase_on_half, std::uint32_t car) {
  const HalfStreet& half = traffic.halves[half_id];
  const double period = traffic.circuits[half.circuit].period_s;
  const double s = distance_after(traffic, half, static_cast<double>(phase_on_half) * (period * 0x1p-64));
  const auto begin = traffic.points.begin() + half.first_point, end = traffic.points.begin() + half.last_point;
  const auto after =
      std::upper_bound(begin + 1, end - 1, s, [](double along, const LanePoint& p) { return along < p.s; });
  const LanePoint &a = *(after - 1), &b = *after;
  const double t = std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0);
  return {glm::mix(a.position, b.position, t), glm::normalize(glm::mix(a.forward, b.forward, t)), car, half_id};
}

/// Which half-street of the circuit a phase lies on.
std::uint32_t half_at(const Traffic& traffic, const Circuit& circuit, std::uint64_t phase) {
  const auto begin = traffic.halves.begin() + circuit.first_half, end = traffic.halves.begin() + circuit.last_half;
  const auto after = std::upper_bound(begin + 1, end, phase,
                                      [](std::uint64_t p, const HalfStreet& half) { return p < half.phase_begin; });
  return static_cast<std::uint32_t>(after - 1 - traffic.halves.begin());
}

/// How many it looked at.
std::uint64_t append_cars_of_half(const Traffic& traffic, std::uint32_t half_id, std::uint64_t tick,
                                  std::vector<CarState>& out) {
  const HalfStreet& half = traffic.halves[half_id];
  const Circuit& circuit = traffic.circuits[half.circuit];
  const auto begin = traffic.offsets.begin() + circuit.first_car, end = traffic.offsets.begin() + circuit.last_car;
  const auto all = static_cast<std::uint64_t>(end - begin);
  if (all == 0) return 0;
  // A car is here when its offset lies in [first, first + length), cyclically.
  const std::uint64_t first = half.phase_begin - phase_run(circuit, tick);
  auto car = std::lower_bound(begin, end, first);
  for (std::uint64_t seen = 0; seen < all; ++seen, ++car) {
    if (car == end) car = begin;
    const std::uint64_t phase_on_half = *car - first;
    if (half.phase_length != 0 && phase_on_half >= half.phase_length) return seen + 1;
    out.push_back(state_on(traffic, half_id, phase_on_half, static_cast<std::uint32_t>(car - traffic.offsets.begin())));
  }
  return all;
}

}  // namespace

std::uint64_t ticks(double seconds) {
  constexpr double kMost = 0x1p62;
  const double n = seconds * kTicksPerSecond;
  return n > 0 ? static_cast<std::uint64_t>(std::llround(std::min(n, kMost))) : 0;
}

std::uint64_t phase_run(const Circuit& circuit, std::uint64_t tick) {
  const std::uint64_t fraction = circuit.step_fraction;
  return tick * circuit.step + (tick >> 32) * fraction + ((tick & 0xffffffffu) * fraction >> 32);
}

CarStats& CarStats::operator+=(const CarStats& more) {
  half_streets += more.half_streets;
  cars += more.cars;
  return *this;
}

CarState car_at(const Traffic& traffic, std::uint32_t car, std::uint64_t tick) {
  assert(car < traffic.cars());
  const auto after = std::upper_bound(traffic.circuits.begin(), traffic.circuits.end(), car,
                                      [](std::uint32_t id, const Circuit& c) { return id < c.last_car; });
  const Circuit& circuit = *after;
  const std::uint64_t phase = traffic.offsets[car] + phase_run(circuit, tick);
  const std::uint32_t half = half_at(traffic, circuit, phase);
  return state_on(traffic, half, phase - traffic.halves[half].phase_begin, car);
}

CarStats cars_of_block(const Traffic& traffic, std::uint32_t block, std::uint64_t tick, std::vector<CarState>& out) {
  assert(block + 1 < traffic.block_first.size());
  CarStats stats;
  for (std::uint32_t row = traffic.block_first[block]; row < traffic.block_first[block + 1]; ++row)
    stats += {1, append_cars_of_half(traffic, traffic.block_halves[row], tick, out)};
  return stats;
}

culling::BoxD half_street_bounds(const Traffic& traffic, std::uint32_t half) {
  assert(half < traffic.halves.size());
  culling::BoxD box;
  for (std::uint32_t p = traffic.halves[half].first_point; p < traffic.halves[half].last_point; ++p)
    box = merge(merge(box, traffic.points[p].position - kCarRadius), traffic.points[p].position + kCarRadius);
  return box;
}

void index_blocks(Traffic& traffic, std::uint32_t blocks) {
  traffic.block_first.assign(blocks + std::size_t{1}, 0);
  traffic.block_halves.resize(traffic.halves.size());
  for (const HalfStreet& half : traffic.halves) ++traffic.block_first[half.block + 1];
  for (std::size_t b = 0; b < blocks; ++b) traffic.block_first[b + 1] += traffic.block_first[b];
  std::vector<std::uint32_t> next(traffic.block_first.begin(), traffic.block_first.end() - 1);
  for (std::uint32_t h = 0; h < traffic.halves.size(); ++h) traffic.block_halves[next[traffic.halves[h].block]++] = h;
}

void reorder_blocks(Traffic& traffic, std::span<const std::uint32_t> new_of_old) {
  for (HalfStreet& half : traffic.halves) {
    assert(half.block < new_of_old.size());
    half.block = new_of_old[half.block];
  }
  index_blocks(traffic, static_cast<std::uint32_t>(new_of_old.size()));
}

}  // namespace manzana
