#include "scenegraph/import/build_traffic.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scenegraph/import/traffic_circuits.h"
#include "scenegraph/import/traffic_hash.h"
#include "scenegraph/import/traffic_signals.h"
#include "scenegraph/import/traffic_write.h"

namespace manzana {
namespace {

constexpr double kLanePerCar = 35;          // metres, by default
constexpr std::uint32_t kMostCars = 20000;  // by default
constexpr double kFilled = 0.9;             // of the slots, at most, as long as cycles can be shorter
constexpr double kWaiting = 1.2;            // time with delays by time without
constexpr double kFewFailures = 0.01;       // of the rides: so many streets may be given up
constexpr double kShortestCycle = 4.2;      // seconds; kHeadwayGap / kSlowest at least
constexpr double kLongestCycle = 24;
constexpr int kRounds = 6;  // of giving up streets

class TrafficBuilder {
 public:
  TrafficBuilder(const StreetGraph& graph, const TrafficOptions& options)
      : graph_(graph), options_(options), lanes_(make_lanes(graph, options.left_hand)), given_up_(graph.edges.size()) {
    pairing_.left_hand = options.left_hand;
    pairing_.no_crossing.assign(graph.junctions.size(), 0);
  }

  /// Streets whose lanes lie on others', and those that no slot can be found for, are given up, round by round.
  TrafficPlan run() {
    for (int round = 0;; ++round) {
      plan();
      const bool last = round == kRounds;
      if (!give_up_overlaps() || last) break;
    }
    for (int round = 0;; ++round) {
      plan_slots();
      if (plan_.slots.failed.empty() || round == kRounds) break;
      mend(round);
      plan();
    }
    close_circuits();
    return std::move(plan_);
  }

 private:
  void plan() {
    std::vector<char> use(lanes_.size(), 1);
    for (std::size_t l = 0; l < lanes_.size(); ++l) use[l] = given_up_[lanes_[l].edge] ? 0 : 1;
    balance(lanes_, static_cast<std::uint32_t>(graph_.junctions.size()), use);
    const std::vector<std::uint32_t> next = pair_lanes(lanes_, graph_, use, pairing_);
    plan_.rides.clear();
    plan_.circuits.clear();
    for (const std::vector<std::uint32_t>& circuit : circuits_of(next)) append_circuit(circuit);
    for (const auto& [first, last] : plan_.circuits) set_speeds(first, last);
  }

  void append_circuit(const std::vector<std::uint32_t>& lanes) {
    const auto first = static_cast<std::uint32_t>(plan_.rides.size());
    const auto count = static_cast<std::uint32_t>(lanes.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      Ride ride{lanes[i], first + (i + 1) % count, first + (i + count - 1) % count, {}, 0, 0, {}};
      const Lane &in = lanes_[lanes[i]], &out = lanes_[lanes[(i + 1) % count]];
      ride.way = way_over_junction(in, out, options_.left_hand);
      ride.way_length = plan_length(ride.way);
      ride.way_speed = std::min(in.speed, out.speed);
      for (std::size_t p = 0; p < ride.way.size(); ++p)
        ride.way_speed = std::min(ride.way_speed, bend_speed(ride.way, p));
      plan_.rides.push_back(std::move(ride));
    }
    plan_.circuits.emplace_back(first, first + count);
  }

  /// The speeds of two ways must be within reach of each other over the lane between them.
  void set_speeds(std::uint32_t first, std::uint32_t last) {
    const auto slow = [&](double& speed, double other, double distance) {
      speed = std::min(speed, std::sqrt(other * other + 2 * kAcceleration * distance));
    };
    for (std::uint32_t i = 0; i < 2 * (last - first); ++i) {
      Ride& forward = plan_.rides[first + i % (last - first)];
      slow(forward.way_speed, plan_.rides[forward.previous].way_speed, lanes_[forward.lane].length);
      Ride& backward = plan_.rides[last - 1 - i % (last - first)];
      slow(plan_.rides[backward.previous].way_speed, backward.way_speed, lanes_[backward.lane].length);
    }
    for (std::uint32_t r = first; r < last; ++r) {
      Ride& ride = plan_.rides[r];
      ride.profile = free_profile(lanes_[ride.lane], plan_.rides[ride.previous].way_speed, ride.way_speed);
    }
  }

  const Lane& lane_of(std::uint32_t ride) const { return lanes_[plan_.rides[ride].lane]; }

  /// Of two streets the slower, then the shorter.
  std::uint32_t lesser(std::uint32_t a, std::uint32_t b) const {
    const auto rank = [&](std::uint32_t r) { return std::pair(lane_of(r).speed, lane_of(r).length); };
    return rank(a) < rank(b) ? a : b;
  }

  bool give_up_overlaps() {
    bool changed = false;
    for (const auto& [a, b] : find_overlaps(lanes_, plan_.rides)) {
      if (given_up_[lane_of(a).edge] || given_up_[lane_of(b).edge]) continue;
      given_up_[lane_of(lesser(a, b)).edge] = 1;
      changed = true;
    }
    return changed;
  }

  double lane_metres() const {
    double sum = 0;
    for (const Ride& ride : plan_.rides) sum += lanes_[ride.lane].length + ride.way_length;
    return sum;
  }

  std::uint32_t wanted_cars() const {
    if (options_.cars >= 0) return static_cast<std::uint32_t>(options_.cars);
    return std::min(kMostCars, static_cast<std::uint32_t>(lane_metres() / kLanePerCar));
  }

  /// The longest cycle that has slots for all: the slower the change, the calmer the traffic.
  double cycle_for_cars() {
    plan_.cars = wanted_cars();
    double driven = 0;
    for (const Ride& ride : plan_.rides) driven += ride.way_time() + lane_time(ride.profile, 1e9);
    return std::clamp(kWaiting * kFilled * driven / std::max(1u, plan_.cars), kShortestCycle, kLongestCycle);
  }

  /// Shorter cycles have more places for cars, longer ones more room at junctions: longer ones are tried as long as
  /// many rides find no slot.
  void plan_slots() {
    const std::vector<Conflict> conflicts = find_conflicts(lanes_, plan_.rides);
    for (double cycle = cycle_for_cars();; cycle *= 1.15) {
      plan_.slots = choose_slots(plan_.rides, conflicts, std::round(cycle * 10) / 10, options_.seed);
      if (double(plan_.slots.failed.size()) <= kFewFailures * double(plan_.rides.size()) || cycle > kLongestCycle)
        return;
    }
  }

  /// First the ways over the junction must not cross, then the street is given up.
  void mend(int round) {
    for (const std::uint32_t r : plan_.slots.failed) {
      char& no_crossing = pairing_.no_crossing[lane_of(r).to];
      if (no_crossing && round > 0) given_up_[lane_of(r).edge] = 1;
      no_crossing = 1;
    }
  }

  /// What is still in each other's way after all rounds stays without cars.
  void close_circuits() {
    plan_.closed.assign(plan_.rides.size(), 0);
    for (const std::uint32_t r : plan_.slots.failed) plan_.closed[r] = 1;
    for (const auto& [a, b] : find_overlaps(lanes_, plan_.rides)) plan_.closed[a] = plan_.closed[b] = 1;
    plan_.lanes = std::move(lanes_);
  }

  const StreetGraph& graph_;
  const TrafficOptions& options_;
  std::vector<Lane> lanes_;
  std::vector<char> given_up_;  // by edge
  PairingOptions pairing_;
  TrafficPlan plan_;
};

}  // namespace

Traffic build_traffic(const LocalFrame& frame, const StreetGraph& graph,
                      std::span<const std::uint32_t> half_street_blocks, std::uint32_t blocks,
                      const TrafficOptions& options) {
  assert(half_street_blocks.size() == 2 * graph.edges.size());
  const TrafficPlan plan = TrafficBuilder(graph, options).run();
  Traffic traffic = write_traffic(frame, plan, half_street_blocks, options.seed);
  index_blocks(traffic, blocks);
  return traffic;
}

}  // namespace manzana
