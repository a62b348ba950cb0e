#include "scenegraph/import/traffic_write.h"

#include <algorithm>
#include <cmath>

#include "culling/hash.h"
#include "scenegraph/import/terrain.h"

namespace manzana {
namespace {

constexpr double kStreetLayer = 0.13;    // metres: carriageways lie so high above the ground
constexpr double kLongestOnRelief = 8;   // metres
constexpr double kLongestPiece = 150;    // metres, of a line on the round Earth: sags by under half a millimetre
constexpr double kBlend = 2;             // metres: from one straight part's heading to the next one's
constexpr double kShortestCircuit = 30;  // metres: shorter ones stay without cars

/// A car's place in time: the k-th slot of a circuit.
struct Place {
  std::uint64_t order;
  std::uint32_t circuit, slot;
};

class Writer {
 public:
  Writer(const LocalFrame& frame, const TrafficPlan& plan, std::span<const std::uint32_t> blocks,
         const Terrain* terrain)
      : frame_(frame), plan_(plan), blocks_(blocks), terrain_(terrain) {}

  Traffic run(std::uint64_t seed) {
    for (const auto& [first, last] : plan_.circuits) append_circuit(first, last);
    place_cars(seed);
    return std::move(out_);
  }

 private:
  double lane_seconds(std::uint32_t r) const {
    return lane_time(plan_.rides[r].profile, kNoCruise) + plan_.slots.delay[r];
  }

  void append_circuit(std::uint32_t first, std::uint32_t last) {
    Circuit circuit{first, last, 0, 0, 0, 0, 0};
    double seconds = 0;
    for (std::uint32_t r = first; r < last; ++r) seconds += lane_seconds(r) + plan_.rides[r].way_time();
    const auto cycles = static_cast<std::uint32_t>(std::llround(seconds / plan_.slots.cycle));
    circuit.period_s = cycles * plan_.slots.cycle;
    set_step(circuit, cycles * static_cast<std::uint64_t>(std::llround(plan_.slots.cycle * kTicksPerSecond)));
    double t = 0;
    for (std::uint32_t r = first; r < last; ++r) {
      append_half(r, phase(t, circuit.period_s));
      t += out_.halves.back().duration_s;
    }
    for (std::uint32_t r = first; r < last; ++r)  // the last one's end wraps to the first one's begin
      out_.halves[r].phase_length = out_.halves[plan_.rides[r].next].phase_begin - out_.halves[r].phase_begin;
    cycles_.push_back(cycles);
    out_.circuits.push_back(circuit);
  }

  static std::uint64_t phase(double t, double period) {
    const double lap = t / period;
    return static_cast<std::uint64_t>(std::ldexp(lap - std::floor(lap), 64));
  }

  void append_half(std::uint32_t r, std::uint64_t phase_begin) {
    const Ride& ride = plan_.rides[r];
    const Lane& lane = plan_.lanes[ride.lane];
    HalfStreet half;
    half.block = blocks_[2 * lane.edge + (lane.against ? 1 : 0)];
    half.circuit = static_cast<std::uint32_t>(out_.circuits.size());
    half.first_point = static_cast<std::uint32_t>(out_.points.size());
    append_points(lane, ride);
    half.last_point = static_cast<std::uint32_t>(out_.points.size());
    half.first_piece = static_cast<std::uint32_t>(out_.pieces.size());
    const double cruise = cruise_for(ride.profile, lane_seconds(r), slowest_cruise(plan_.slots.cycle));
    append_pieces(out_.pieces, ride.profile, cruise, ride.way_speed);
    half.last_piece = static_cast<std::uint32_t>(out_.pieces.size());
    half.phase_begin = phase_begin;
    half.duration_s = lane_seconds(r) + ride.way_time();
    out_.halves.push_back(half);
  }

  bool relief() const { return terrain_ != nullptr && !terrain_->level(); }
  Vec3d on_ground(const Vec3d& p) const {
    const Vec2d plan(p);
    return {plan, frame_.ground_z(plan) + (relief() ? terrain_->at(plan) : 0) + p.z + kStreetLayer};
  }

  void append_points(const Lane& lane, const Ride& ride) {
    const std::size_t first = out_.points.size();
    append_line(lane.line, 0);
    append_line(ride.way, 1);
    const std::vector<Vec3d>& onward = plan_.lanes[plan_.rides[ride.next].lane].line;
    set_tangents(std::span(out_.points.own()).subspan(first), direction(on_ground(onward[0]), on_ground(onward[1])));
  }

  /// Points from `first` on. Straight parts get points near their ends, so that headings are blended only there, and
  /// long ones more, because the ground is round.
  void append_line(const std::vector<Vec3d>& line, std::size_t first) {
    if (first == 0) out_.points.own().push_back({on_ground(line[0]), 0, {}});
    for (std::size_t i = 1; i < line.size(); ++i) append_straight(line[i - 1], line[i]);
  }

  void append_straight(const Vec3d& a, const Vec3d& b) {
    const double length = glm::distance(Vec2d(a), Vec2d(b)), s = out_.points.own().back().s;
    const auto add = [&](double along) {
      out_.points.own().push_back({on_ground(glm::mix(a, b, along / length)), s + along, {}});
    };
    if (length > 3 * kBlend) {
      const int parts =
          std::max(1, static_cast<int>(std::ceil(length / (relief() ? kLongestOnRelief : kLongestPiece))));
      for (int k = 0; k <= parts; ++k) add(kBlend + (length - 2 * kBlend) * k / parts);
    }
    add(length);
  }

  static Vec3d direction(const Vec3d& a, const Vec3d& b) { return glm::normalize(b - a); }

  /// Tangents of the circle through three points: a half-street's last is the next one's first.
  static void set_tangents(std::span<LanePoint> p, const Vec3d& onward) {
    p.front().forward = direction(p[0].position, p[1].position);
    p.back().forward = onward;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      const Vec3d before = p[i].position - p[i - 1].position, after = p[i + 1].position - p[i].position;
      const double l = glm::dot(before, before), m = glm::dot(after, after);
      p[i].forward = glm::normalize(before * m + after * l);
    }
  }

  bool carries_cars(std::uint32_t circuit) const {
    const auto [first, last] = plan_.circuits[circuit];
    double metres = 0;
    for (std::uint32_t r = first; r < last; ++r) metres += out_.points[out_.halves[r].last_point - 1].s;
    return metres >= kShortestCircuit;
  }

  void place_cars(std::uint64_t seed) {
    std::vector<Place> places;
    for (std::uint32_t c = 0; c < out_.circuits.size(); ++c)
      for (std::uint32_t k = 0; carries_cars(c) && k < cycles_[c]; ++k)
        places.push_back({hash_bits(seed, places.size()), c, k});
    const std::size_t count = std::min<std::size_t>(plan_.cars, places.size());
    std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count), places.end(),
                     [](const Place& a, const Place& b) { return a.order < b.order; });
    places.resize(count);
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.circuit < b.circuit; });
    std::size_t at = 0;
    for (std::uint32_t c = 0; c < out_.circuits.size(); ++c) {
      Circuit& circuit = out_.circuits[c];
      circuit.first_car = static_cast<std::uint32_t>(out_.offsets.size());
      for (; at < places.size() && places[at].circuit == c; ++at) out_.offsets.push_back(offset(places[at]));
      circuit.last_car = static_cast<std::uint32_t>(out_.offsets.size());
      std::sort(out_.offsets.begin() + circuit.first_car, out_.offsets.end());
    }
  }

  /// The phase at time 0 of the car that leaves the circuit's first lane at its slot plus k cycles.
  std::uint64_t offset(const Place& place) const {
    const Circuit& circuit = out_.circuits[place.circuit];
    const double begin = plan_.slots.slot[circuit.first_half] - lane_seconds(circuit.first_half);
    return phase(place.slot * plan_.slots.cycle - begin, circuit.period_s);
  }

  const LocalFrame& frame_;
  const TrafficPlan& plan_;
  std::span<const std::uint32_t> blocks_;
  const Terrain* terrain_;
  Traffic out_;
  std::vector<std::uint32_t> cycles_;  // of a lap, by circuit
};

}  // namespace

void set_step(Circuit& circuit, std::uint64_t ticks_a_lap) {
  constexpr std::uint64_t kMost = ~std::uint64_t{0};
  circuit.step = kMost / ticks_a_lap;
  std::uint64_t rest = kMost % ticks_a_lap + 1;  // under 2^63
  if (rest == ticks_a_lap) ++circuit.step, rest = 0;
  for (int bit = 0; bit < 32; ++bit) {
    rest *= 2;
    circuit.step_fraction = 2 * circuit.step_fraction + (rest >= ticks_a_lap ? 1 : 0);
    if (rest >= ticks_a_lap) rest -= ticks_a_lap;
  }
}

Traffic write_traffic(const LocalFrame& frame, const TrafficPlan& plan,
                      std::span<const std::uint32_t> half_street_blocks, std::uint64_t seed, const Terrain* terrain) {
  return Writer(frame, plan, half_street_blocks, terrain).run(seed);
}

}  // namespace manzana
