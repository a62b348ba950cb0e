#include "scenegraph/import/street_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "scenegraph/import/bridge_crossings.h"

namespace manzana {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kStep = 10;          // metres between points on slopes
constexpr double kMostSteps = 200;    // but an edge gets no more than that
constexpr double kSnap = 0.1;         // metres: bends nearer to a point than that need none of their own
constexpr double kArchRise = 1.5;     // metres
constexpr double kArchOfLength = 15;  // an arch rises 1/15 of its length at most
constexpr std::uint32_t kNoArch = ~0U;

struct Arch {
  double half_length = 0;
  double height(double from_end) const {
    if (!(half_length > 0) || from_end == kInf) return 0;
    const double wave = std::sin(0.5 * std::numbers::pi * std::min(1.0, from_end / half_length));
    return std::min(kArchRise, 2 * half_length / kArchOfLength) * wave * wave;
  }
};

// What an edge's heights follow from; s in metres from its start.
struct Profile {
  double length = 0, from = 0, to = 0;  // heights of its ends by ramps alone
  Span level;                           // lifted to `deck`
  double deck = 0;
  Arch arch;
  double arch_from = kInf, arch_to = kInf;  // distances of its ends from the arch's ends

  double ramp(double s) const {
    const double ends = std::max(from - kRampGrade * s, to - kRampGrade * (length - s));
    if (level.empty()) return std::max(0.0, ends);
    return std::max({0.0, ends, deck - kRampGrade * std::max({0.0, level.s0 - s, s - level.s1})});
  }
  double height(double s) const {
    return std::max(ramp(s), arch.height(std::min(arch_from + s, arch_to + length - s)));
  }
  bool flat() const { return from == 0 && to == 0 && level.empty() && !(arch.half_length > 0); }
  // Where lines of the profile meet; some may lie beyond the edge, or under another line.
  std::vector<double> bends() const {
    std::vector<double> s{from / kRampGrade, length - to / kRampGrade, 0.5 * ((from - to) / kRampGrade + length)};
    if (!level.empty())
      s.insert(s.end(),
               {level.s0, level.s1, level.s0 - deck / kRampGrade, level.s1 + deck / kRampGrade,
                0.5 * ((from - deck) / kRampGrade + level.s0), 0.5 * ((deck - to) / kRampGrade + length + level.s1)});
    return s;
  }
};

// Largest (ramps) or least (arches) value first.
template <class Compare>
using Queue =
    std::priority_queue<std::pair<double, std::uint32_t>, std::vector<std::pair<double, std::uint32_t>>, Compare>;

class Raiser {
 public:
  explicit Raiser(StreetGraph& graph)
      : graph_(graph),
        level_(spans_over_streets(graph)),
        ramp_(graph.junctions.size(), 0),
        from_end_(graph.junctions.size(), kInf),
        arch_of_(graph.junctions.size(), kNoArch) {}

  void run() {
    join_levels();
    spread_ramps();
    find_arches();
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) shape(e);
    for (std::uint32_t j = 0; j < graph_.junctions.size(); ++j) graph_.junctions[j].position.z = junction_height(j);
  }

 private:
  bool bridge(std::uint32_t e) const { return graph_.streets[graph_.edges[e].street].bridge; }
  double deck(std::uint32_t e) const {
    return kBridgeRise * std::max(0, deck_layer(graph_.streets[graph_.edges[e].street]));
  }
  std::uint32_t other(std::uint32_t e, std::uint32_t j) const {
    return graph_.edges[e].from == j ? graph_.edges[e].to : graph_.edges[e].from;
  }

  // Bridges between lifted ones are lifted too: from the network of bridges, take away free ends that cross nothing.
  void join_levels() {
    std::vector<std::uint32_t> degree(graph_.junctions.size(), 0), todo;
    std::vector<bool> kept(graph_.edges.size());
    for (std::uint32_t e = 0; e < kept.size(); ++e) {
      kept[e] = bridge(e) && deck(e) > 0;
      if (kept[e]) ++degree[graph_.edges[e].from], ++degree[graph_.edges[e].to];
    }
    for (std::uint32_t j = 0; j < degree.size(); ++j) todo.push_back(j);
    while (!todo.empty()) {
      const std::uint32_t j = todo.back();
      todo.pop_back();
      for (std::uint32_t e : graph_.junctions[j].edges) {
        if (degree[j] != 1 || !kept[e] || !level_[e].empty()) continue;
        kept[e] = false;
        --degree[j], --degree[other(e, j)];
        todo.push_back(other(e, j));
      }
    }
    keep_lifted(kept);
    for (std::uint32_t e = 0; e < kept.size(); ++e)
      if (kept[e]) extend(e, degree[graph_.edges[e].from] > 1, degree[graph_.edges[e].to] > 1);
  }

  // Rings of bridges that cross nothing, and are joined to none that does, are left over: they stay down.
  void keep_lifted(std::vector<bool>& kept) const {
    std::vector<bool> reached(kept.size());
    std::vector<std::uint32_t> todo;
    for (std::uint32_t e = 0; e < kept.size(); ++e)
      if (kept[e] && !level_[e].empty()) todo.push_back(e), reached[e] = true;
    while (!todo.empty()) {
      const StreetEdge& edge = graph_.edges[todo.back()];
      todo.pop_back();
      for (std::uint32_t j : {edge.from, edge.to})
        for (std::uint32_t e : graph_.junctions[j].edges)
          if (kept[e] && !reached[e]) todo.push_back(e), reached[e] = true;
    }
    kept = std::move(reached);
  }

  void extend(std::uint32_t e, bool through_from, bool through_to) {
    const double end = graph_.edges[e].length;
    const bool crosses = !level_[e].empty();
    level_[e] = {crosses && !through_from ? level_[e].s0 : 0, crosses && !through_to ? level_[e].s1 : end};
  }

  // Heights fall by kRampGrade: Dijkstra's algorithm from all lifted places at once, the highest first.
  void spread_ramps() {
    Queue<std::less<>> todo;
    const auto raise = [&](std::uint32_t j, double height) {
      if (height > ramp_[j]) todo.emplace(ramp_[j] = height, j);
    };
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
      if (level_[e].empty()) continue;
      raise(graph_.edges[e].from, deck(e) - kRampGrade * level_[e].s0);
      raise(graph_.edges[e].to, deck(e) - kRampGrade * (graph_.edges[e].length - level_[e].s1));
    }
    while (!todo.empty()) {
      const auto [height, j] = todo.top();
      todo.pop();
      if (height < ramp_[j]) continue;
      for (std::uint32_t e : graph_.junctions[j].edges)
        raise(other(e, j), height - kRampGrade * graph_.edges[e].length);
    }
  }

  // An arch spans bridges that are joined; its ends are where no bridge, or also another street, goes on.
  void find_arches() {
    Queue<std::greater<>> todo;
    for (std::uint32_t j = 0; j < graph_.junctions.size(); ++j) {
      const auto& edges = graph_.junctions[j].edges;
      const auto bridges = std::count_if(edges.begin(), edges.end(), [&](std::uint32_t e) { return bridge(e); });
      if (bridges > 0 && (bridges == 1 || static_cast<std::size_t>(bridges) < edges.size()))
        todo.emplace(from_end_[j] = 0, j);
    }
    while (!todo.empty()) {
      const auto [distance, j] = todo.top();
      todo.pop();
      for (std::uint32_t e : graph_.junctions[j].edges) {
        const double next = distance + graph_.edges[e].length;
        if (!bridge(e) || distance > from_end_[j] || next >= from_end_[other(e, j)]) continue;
        todo.emplace(from_end_[other(e, j)] = next, other(e, j));
      }
    }
    measure_arches();
  }

  // Edges that share a junction inside an arch share the arch. Ends belong to several: there it has no height.
  void measure_arches() {
    edge_arch_.assign(graph_.edges.size(), kNoArch);
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
      if (!bridge(e) || edge_arch_[e] != kNoArch) continue;
      const auto arch = static_cast<std::uint32_t>(arches_.size());
      arches_.push_back({});
      std::vector<std::uint32_t> todo{e};
      edge_arch_[e] = arch;
      while (!todo.empty()) {
        const StreetEdge& edge = graph_.edges[todo.back()];
        todo.pop_back();
        const double half = 0.5 * (from_end_[edge.from] + from_end_[edge.to] + edge.length);
        if (half < kInf) arches_[arch].half_length = std::max(arches_[arch].half_length, half);
        for (std::uint32_t j : {edge.from, edge.to}) visit_inside(j, arch, todo);
      }
    }
  }

  void visit_inside(std::uint32_t j, std::uint32_t arch, std::vector<std::uint32_t>& todo) {
    if (from_end_[j] == 0) return;
    arch_of_[j] = arch;
    for (std::uint32_t e : graph_.junctions[j].edges)
      if (bridge(e) && edge_arch_[e] == kNoArch) todo.push_back(e), edge_arch_[e] = arch;
  }

  double junction_height(std::uint32_t j) const {
    return arch_of_[j] == kNoArch ? ramp_[j] : std::max(ramp_[j], arches_[arch_of_[j]].height(from_end_[j]));
  }

  Profile profile(std::uint32_t e) const {
    const StreetEdge& edge = graph_.edges[e];
    Profile p{edge.length, ramp_[edge.from], ramp_[edge.to], level_[e], deck(e), {}, kInf, kInf};
    if (edge_arch_[e] == kNoArch) return p;
    p.arch = arches_[edge_arch_[e]];
    p.arch_from = from_end_[edge.from];
    p.arch_to = from_end_[edge.to];
    return p;
  }

  void shape(std::uint32_t e) {
    const Profile p = profile(e);
    if (p.flat()) return;
    StreetEdge& edge = graph_.edges[e];
    std::vector<double> bends = p.bends();
    std::sort(bends.begin(), bends.end());
    std::vector<Vec3d> shaped;
    double s = 0;
    for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
      const double length =
          std::hypot(edge.points[i + 1].x - edge.points[i].x, edge.points[i + 1].y - edge.points[i].y);
      shape_segment(p, bends, Vec2d(edge.points[i]), Vec2d(edge.points[i + 1]), s, length, shaped);
      s += length;
    }
    shaped.emplace_back(Vec2d(edge.points.back()), 0);
    shaped.front().z = junction_height(edge.from);
    shaped.back().z = junction_height(edge.to);
    edge.points = std::move(shaped);
  }

  // Appends all but the segment's end.
  static void shape_segment(const Profile& p, const std::vector<double>& bends, const Vec2d& a, const Vec2d& b,
                            double s, double length, std::vector<Vec3d>& out) {
    std::vector<double> stations{s};
    for (double bend : bends)
      if (bend > stations.back() + kSnap && bend < s + length - kSnap) stations.push_back(bend);
    stations.push_back(s + length);
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      const double s0 = stations[i], s1 = stations[i + 1], mid = p.height(0.5 * (s0 + s1));
      const bool level = p.height(s0) == mid && mid == p.height(s1);
      const double steps = level ? 1 : std::ceil((s1 - s0) / std::max(kStep, p.length / kMostSteps));
      for (int k = 0; k < steps; ++k) {
        const double at = s0 + (s1 - s0) * k / steps;
        const Vec2d place = k == 0 && i == 0 ? a : glm::mix(a, b, (at - s) / length);
        if (out.empty() || (place != Vec2d(out.back()) && (place != b))) out.emplace_back(place, p.height(at));
      }
    }
  }

  StreetGraph& graph_;
  std::vector<Span> level_;              // a row an edge: what is lifted to its deck
  std::vector<double> ramp_, from_end_;  // a row a junction
  std::vector<std::uint32_t> arch_of_;   // a row a junction
  std::vector<std::uint32_t> edge_arch_;
  std::vector<Arch> arches_;
};

}  // namespace

void raise_streets(StreetGraph& graph) {
  const bool bridges = std::any_of(graph.edges.begin(), graph.edges.end(),
                                   [&](const StreetEdge& e) { return graph.streets[e.street].bridge; });
  if (bridges) Raiser(graph).run();
}

}  // namespace manzana
