#include "scenegraph/import/traffic_circuits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

namespace manzana {
namespace {

class Balancer {
 public:
  Balancer(std::span<const Lane> lanes, std::uint32_t junctions, std::vector<char>& use)
      : lanes_(lanes), use_(use), outs_(junctions), excess_(junctions, 0), distance_(junctions), via_(junctions) {
    for (std::uint32_t l = 0; l < lanes.size(); ++l) {
      if (!use[l]) continue;
      outs_[lanes[l].from].push_back(l);
      ++excess_[lanes[l].from];
      --excess_[lanes[l].to];
    }
  }

  void run() {
    std::fill(distance_.begin(), distance_.end(), kFar);
    for (std::uint32_t j = 0; j < excess_.size(); ++j)
      while (excess_[j] > 0) give_up_path(j);
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  using Entry = std::pair<double, std::uint32_t>;

  void give_up_path(std::uint32_t start) {
    std::vector<std::uint32_t> touched;
    std::uint32_t at = nearest_short(start, touched);
    ++excess_[at];
    for (; at != start; at = lanes_[via_[at]].from) use_[via_[at]] = 0;
    --excess_[start];
    for (const std::uint32_t j : touched) distance_[j] = kFar;
  }

  /// Dijkstra to the nearest junction with too many ways in.
  std::uint32_t nearest_short(std::uint32_t start, std::vector<std::uint32_t>& touched) {
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> todo;
    const auto reach = [&](std::uint32_t junction, double distance, std::uint32_t lane) {
      if (distance >= distance_[junction]) return;
      touched.push_back(junction);
      distance_[junction] = distance;
      via_[junction] = lane;
      todo.emplace(distance, junction);
    };
    reach(start, 0, kNoLane);
    while (true) {
      const auto [distance, at] = todo.top();
      todo.pop();
      if (distance > distance_[at]) continue;
      if (excess_[at] < 0) return at;
      for (const std::uint32_t l : outs_[at])
        if (use_[l]) reach(lanes_[l].to, distance + lanes_[l].length, l);
    }
  }

  std::span<const Lane> lanes_;
  std::vector<char>& use_;
  std::vector<std::vector<std::uint32_t>> outs_;  // by junction
  std::vector<int> excess_;                       // ways out less ways in
  std::vector<double> distance_;
  std::vector<std::uint32_t> via_;
};

/// The assignment at one junction: ins_[i] is followed by outs_[choice[i]].
class JunctionPairing {
 public:
  JunctionPairing(std::span<const Lane> lanes, const Junction& junction, bool left_hand, bool no_crossing)
      : lanes_(lanes), center_(junction.position), left_hand_(left_hand), no_crossing_(no_crossing) {}

  void add_in(std::uint32_t lane) { ins_.push_back({lane, angle_of(lanes_[lane].line.back())}); }
  void add_out(std::uint32_t lane) { outs_.push_back({lane, angle_of(lanes_[lane].line.front())}); }

  void write(std::vector<std::uint32_t>& next) {
    if (ins_.empty()) return;
    std::vector<std::size_t> choice(ins_.size());
    std::iota(choice.begin(), choice.end(), std::size_t{0});
    fill_costs();
    choice = ins_.size() <= kTryAll ? best_of_all(choice) : exchanged(choice);
    for (std::size_t i = 0; i < ins_.size(); ++i) next[ins_[i].lane] = outs_[choice[i]].lane;
  }

 private:
  struct End {
    std::uint32_t lane;
    double angle;  // seen from the junction
  };

  double angle_of(const Vec3d& p) const { return std::atan2(p.y - center_.y, p.x - center_.x); }

  /// Without crossings: how far round the junction, from the kerb side on. Least in sum when each takes the next way
  /// out.
  double turn_cost(const End& from, const End& to) const {
    const Lane &in = lanes_[from.lane], &out = lanes_[to.lane];
    if (in.edge == out.edge && in.against != out.against) return 50;
    const double round = (to.angle - from.angle) * (left_hand_ ? -1 : 1);
    if (no_crossing_) return round < 0 ? round + 2 * std::numbers::pi : round;
    const double turn = turn_angle(end_direction(in), start_direction(out)) * (left_hand_ ? -1 : 1);
    return turn < 0 ? -turn : 1.7 * turn;
  }

  void fill_costs() {
    for (const End& in : ins_)
      for (const End& out : outs_) costs_.push_back(turn_cost(in, out));
  }

  static bool between(double a, double b, double x) { return a < b ? a < x && x < b : x < b || a < x; }
  bool crosses(const End& in, const End& out, const End& other_in, const End& other_out) const {
    return between(in.angle, out.angle, other_in.angle) != between(in.angle, out.angle, other_out.angle);
  }

  double cost(const std::vector<std::size_t>& choice) const {
    double sum = 0;
    for (std::size_t i = 0; i < choice.size(); ++i) {
      sum += costs_[i * outs_.size() + choice[i]];
      for (std::size_t k = 0; k < i; ++k)
        if (crosses(ins_[i], outs_[choice[i]], ins_[k], outs_[choice[k]])) sum += kCrossingCost;
    }
    return sum;
  }

  std::vector<std::size_t> best_of_all(std::vector<std::size_t> choice) const {
    std::vector<std::size_t> best = choice;
    double least = cost(choice);
    while (std::next_permutation(choice.begin(), choice.end())) {
      const double c = cost(choice);
      if (c < least) least = c, best = choice;
    }
    return best;
  }

  std::vector<std::size_t> exchanged(std::vector<std::size_t> choice) const {
    double least = cost(choice);
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 0; i < choice.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
          std::swap(choice[i], choice[k]);
          const double c = cost(choice);
          if (c < least - 1e-9)
            least = c, better = true;
          else
            std::swap(choice[i], choice[k]);
        }
    }
    return choice;
  }

  static constexpr double kCrossingCost = 0.25;
  std::span<const Lane> lanes_;
  Vec3d center_;
  bool left_hand_, no_crossing_;
  std::vector<End> ins_, outs_;
  std::vector<double> costs_;  // a row an in, a column an out
};

}  // namespace

void balance(std::span<const Lane> lanes, std::uint32_t junctions, std::vector<char>& use) {
  Balancer(lanes, junctions, use).run();
}

std::vector<std::uint32_t> pair_lanes(std::span<const Lane> lanes, const StreetGraph& graph,
                                      const std::vector<char>& use, const PairingOptions& options) {
  std::vector<JunctionPairing> pairings;
  pairings.reserve(graph.junctions.size());
  for (std::size_t j = 0; j < graph.junctions.size(); ++j)
    pairings.emplace_back(lanes, graph.junctions[j], options.left_hand, options.no_crossing[j] != 0);
  for (std::uint32_t l = 0; l < lanes.size(); ++l) {
    if (!use[l]) continue;
    pairings[lanes[l].to].add_in(l);
    pairings[lanes[l].from].add_out(l);
  }
  std::vector<std::uint32_t> next(lanes.size(), kNoLane);
  for (JunctionPairing& pairing : pairings) pairing.write(next);
  return next;
}

std::vector<std::vector<std::uint32_t>> circuits_of(std::span<const std::uint32_t> next) {
  std::vector<std::vector<std::uint32_t>> circuits;
  std::vector<char> seen(next.size(), 0);
  for (std::uint32_t first = 0; first < next.size(); ++first) {
    if (next[first] == kNoLane || seen[first]) continue;
    circuits.emplace_back();
    for (std::uint32_t l = first; !seen[l]; l = next[l]) {
      seen[l] = 1;
      circuits.back().push_back(l);
    }
  }
  return circuits;
}

}  // namespace manzana
