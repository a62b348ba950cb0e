#include "scenegraph/import/build_traffic.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "culling/hash.h"
#include "scenegraph/import/traffic_check.h"
#include "scenegraph/import/traffic_circuits.h"
#include "scenegraph/import/traffic_signals.h"
#include "scenegraph/import/traffic_write.h"

namespace manzana {
namespace {

constexpr double kLanePerCar = 35;          // metres, by default
constexpr std::uint32_t kMostCars = 20000;  // by default
constexpr double kFilled = 0.9;             // of the slots, at most, as long as cycles can be shorter
constexpr double kWaiting = 1.05;           // time with delays by time without
constexpr double kFewFailures = 0.02;       // of the rides: so many streets may be given up
constexpr double kShortestCycle = 4.2;      // seconds; kHeadwayGap / kSlowest at least
constexpr double kLongestCycle = 24;
constexpr double kLongestSearch = 9;  // seconds: cycles are not made longer than this to get more slots
constexpr int kPatience = 2;          // rounds of pairing anew, before streets are given up at once

class TrafficBuilder {
 public:
  TrafficBuilder(const StreetGraph& graph, const TrafficOptions& options)
      : graph_(graph), options_(options), given_up_(graph.edges.size()) {
    plan_.lanes = make_lanes(graph, options.left_hand);
    pairing_.left_hand = options.left_hand;
    pairing_.no_crossing.assign(graph.junctions.size(), 0);
  }

  /// Streets whose lanes lie on others', those that no slot can be found for, and those where cars touch all the same,
  /// are given up, round by round, until nothing is in the way. Ends, because after kPatience rounds each gives one up.
  TrafficPlan run() {
    do plan();
    while (give_up_overlaps() || mend_slots() || give_up_meetings());
    plan_.cars = wanted_cars();
    return std::move(plan_);
  }

 private:
  void plan() {
    std::vector<char> use(plan_.lanes.size(), 1);
    for (std::size_t l = 0; l < plan_.lanes.size(); ++l) use[l] = given_up_[plan_.lanes[l].edge] ? 0 : 1;
    balance(plan_.lanes, static_cast<std::uint32_t>(graph_.junctions.size()), use);
    const std::vector<std::uint32_t> next = pair_lanes(plan_.lanes, graph_, use, pairing_);
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
      const Lane &in = plan_.lanes[lanes[i]], &out = plan_.lanes[lanes[(i + 1) % count]];
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
      slow(forward.way_speed, plan_.rides[forward.previous].way_speed, plan_.lanes[forward.lane].length);
      Ride& backward = plan_.rides[last - 1 - i % (last - first)];
      slow(plan_.rides[backward.previous].way_speed, backward.way_speed, plan_.lanes[backward.lane].length);
    }
    for (std::uint32_t r = first; r < last; ++r) {
      Ride& ride = plan_.rides[r];
      ride.profile = free_profile(plan_.lanes[ride.lane], plan_.rides[ride.previous].way_speed, ride.way_speed);
    }
  }

  const Lane& lane_of(std::uint32_t ride) const { return plan_.lanes[plan_.rides[ride].lane]; }

  /// Of two streets the slower is given up, then the shorter.
  std::pair<double, double> rank(std::uint32_t r) const { return {lane_of(r).speed, lane_of(r).length}; }
  std::uint32_t lesser(std::uint32_t a, std::uint32_t b) const { return rank(a) < rank(b) ? a : b; }

  bool give_up_lessers(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    for (const auto& [a, b] : pairs)
      if (!given_up_[lane_of(a).edge] && !given_up_[lane_of(b).edge]) given_up_[lane_of(lesser(a, b)).edge] = 1;
    return !pairs.empty();
  }
  bool give_up_overlaps() { return give_up_lessers(find_overlaps(plan_.lanes, plan_.rides)); }

  bool give_up_meetings() {
    plan_.cars = ~std::uint32_t{0};
    const std::vector<std::uint32_t> no_blocks(2 * graph_.edges.size(), 0);
    const Traffic full = write_traffic(LocalFrame(), plan_, no_blocks, options_.seed, nullptr);
    return give_up_lessers(find_meetings(full, plan_.slots.cycle));
  }

  /// First the ways over a junction where slots are short must not cross, then one of its streets is given up.
  bool mend_slots() {
    plan_slots();
    std::vector<std::uint32_t> failed = plan_.slots.failed;
    std::sort(failed.begin(), failed.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    std::vector<char> seen(graph_.junctions.size(), 0);
    for (const std::uint32_t r : failed) {
      const std::uint32_t junction = lane_of(r).to;
      if (seen[junction]) continue;
      seen[junction] = 1;
      if (pairing_.no_crossing[junction] || mends_ >= kPatience) given_up_[lane_of(r).edge] = 1;
      pairing_.no_crossing[junction] = 1;
    }
    ++mends_;
    return !failed.empty();
  }

  double lane_metres() const {
    double sum = 0;
    for (const Ride& ride : plan_.rides) sum += plan_.lanes[ride.lane].length + ride.way_length;
    return sum;
  }

  std::uint32_t wanted_cars() const {
    if (options_.cars >= 0) return static_cast<std::uint32_t>(options_.cars);
    return std::min(kMostCars, static_cast<std::uint32_t>(lane_metres() / kLanePerCar));
  }

  /// The longest cycle that has slots for all: the slower the change, the calmer the traffic.
  double cycle_for_cars() const {
    double driven = 0;
    for (const Ride& ride : plan_.rides) driven += ride.way_time() + lane_time(ride.profile, kNoCruise);
    return std::clamp(kWaiting * kFilled * driven / std::max(1u, wanted_cars()), kShortestCycle, kLongestCycle);
  }

  /// Shorter cycles have more places for cars, longer ones more room at junctions: longer ones are tried as long as
  /// many rides find no slot.
  void plan_slots() {
    const std::vector<Conflict> conflicts = find_conflicts(plan_.lanes, plan_.rides);
    for (cycle_ = std::max(cycle_, cycle_for_cars());; cycle_ *= 1.15) {
      plan_.slots = choose_slots(plan_.rides, conflicts, std::round(cycle_ * 10) / 10, options_.seed);
      const double share = double(plan_.slots.failed.size()) / std::max(1.0, double(plan_.rides.size()));
      if (share <= kFewFailures || cycle_ > kLongestSearch) return;
    }
  }

  const StreetGraph& graph_;
  const TrafficOptions& options_;
  std::vector<char> given_up_;  // by edge
  PairingOptions pairing_;
  int mends_ = 0;
  double cycle_ = kShortestCycle;  // seconds; grows from round to round
  TrafficPlan plan_;
};

}  // namespace

Traffic build_traffic(const LocalFrame& frame, const StreetGraph& graph,
                      std::span<const std::uint32_t> half_street_blocks, std::uint32_t blocks,
                      const TrafficOptions& options) {
  assert(half_street_blocks.size() == 2 * graph.edges.size());
  const TrafficPlan plan = TrafficBuilder(graph, options).run();
  Traffic traffic = write_traffic(frame, plan, half_street_blocks, options.seed, options.terrain);
  index_blocks(traffic, blocks);
  return traffic;
}

}  // namespace manzana
