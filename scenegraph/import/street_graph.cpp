#include "scenegraph/import/street_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenegraph/import/street_heights.h"

namespace manzana {
namespace {

constexpr std::uint32_t kNone = ~0U;
constexpr double kFarthest = 1e8;  // metres: beyond the Earth's diameter

bool has_two_points(const std::vector<Vec2d>& line) {
  return std::any_of(line.begin(), line.end(), [&](const Vec2d& p) { return p != line[0]; });
}

// Null when the street can be used.
const char* fault_of(const StreetFeature& street) {
  if (street.nodes.size() != street.line.size()) return "not one node id for each point";
  for (const Vec2d& p : street.line)
    if (!(std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest))
      return "a coordinate is not finite or out of range";
  return has_two_points(street.line) ? nullptr : "fewer than two different points";
}

// The nodes of the streets under small numbers, with the place where each was seen first.
class Nodes {
 public:
  explicit Nodes(const std::vector<const StreetFeature*>& streets) {
    for (const StreetFeature* street : streets) {
      positions_.insert(positions_.end(), street->line.begin(), street->line.end());
      ids_.insert(ids_.end(), street->nodes.begin(), street->nodes.end());
    }
    number();
    std::size_t point = 0;
    for (const StreetFeature* street : streets) {
      for (std::size_t i = 1; i < street->line.size(); ++i)
        if (position(point + i - 1) == position(point + i)) merge(point + i - 1, point + i);
      point += street->line.size();
    }
  }
  // Of a point, counted through all streets: the same for all points that are one place in the network.
  std::uint32_t node(std::size_t point) const { return root(first_[point]); }
  const Vec2d& place(std::uint32_t node) const { return positions_[node]; }
  std::size_t size() const { return first_.size(); }

 private:
  // first_: the first point with the same id.
  void number() {
    std::vector<std::uint32_t> order(ids_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return ids_[a] != ids_[b] ? ids_[a] < ids_[b] : a < b; });
    first_.resize(ids_.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      first_[order[i]] = i > 0 && ids_[order[i]] == ids_[order[i - 1]] ? first_[order[i - 1]] : order[i];
    parent_.resize(ids_.size());
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  const Vec2d& position(std::size_t point) const { return positions_[first_[point]]; }
  std::uint32_t root(std::uint32_t n) const {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  // Neighbours at one place would make a piece without length: they are one node.
  void merge(std::size_t a, std::size_t b) {
    const std::uint32_t p = node(a), q = node(b);
    parent_[std::max(p, q)] = std::min(p, q);
  }

  std::vector<Vec2d> positions_;
  std::vector<std::int64_t> ids_;
  std::vector<std::uint32_t> first_;
  mutable std::vector<std::uint32_t> parent_;
};

double plan_length(const std::vector<Vec3d>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return sum;
}

class Cutter {
 public:
  Cutter(StreetGraph& graph, const std::vector<std::uint32_t>& rows) : graph_(graph), rows_(rows), nodes_(used()) {
    junction_.assign(nodes_.size(), kNone);
    uses_.assign(nodes_.size(), 0);
  }

  void run(std::vector<Issue>& issues) {
    std::vector<std::vector<std::uint32_t>> paths;
    std::size_t point = 0;
    for (std::uint32_t row : rows_) {
      paths.push_back(path_of(point, graph_.streets[row].line.size()));
      point += graph_.streets[row].line.size();
      for (std::uint32_t node : paths.back()) ++uses_[node];
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (paths[i].size() > 1)
        cut(rows_[i], paths[i]);
      else
        issues.push_back({graph_.streets[rows_[i]].where, "all its nodes are at one place"});
    }
  }

 private:
  std::vector<const StreetFeature*> used() const {
    std::vector<const StreetFeature*> result;
    for (std::uint32_t row : rows_) result.push_back(&graph_.streets[row]);
    return result;
  }

  std::vector<std::uint32_t> path_of(std::size_t first, std::size_t count) const {
    std::vector<std::uint32_t> path;
    path.reserve(count);
    for (std::size_t i = first; i < first + count; ++i)
      if (const std::uint32_t n = nodes_.node(i); path.empty() || path.back() != n) path.push_back(n);
    return path;
  }

  void cut(std::uint32_t street, const std::vector<std::uint32_t>& path) {
    std::size_t begin = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (i + 1 < path.size() && uses_[path[i]] < 2) continue;
      add_edge(street, std::span(path).subspan(begin, i + 1 - begin));
      begin = i;
    }
  }

  void add_edge(std::uint32_t street, std::span<const std::uint32_t> path) {
    StreetEdge edge{junction(path.front()), junction(path.back()), {}, street, 0};
    edge.points.reserve(path.size());
    for (std::uint32_t node : path) edge.points.emplace_back(nodes_.place(node), 0.0);
    edge.length = plan_length(edge.points);
    const auto row = static_cast<std::uint32_t>(graph_.edges.size());
    graph_.junctions[edge.from].edges.push_back(row);
    graph_.junctions[edge.to].edges.push_back(row);
    graph_.edges.push_back(std::move(edge));
  }

  std::uint32_t junction(std::uint32_t node) {
    if (junction_[node] == kNone) {
      junction_[node] = static_cast<std::uint32_t>(graph_.junctions.size());
      graph_.junctions.push_back({Vec3d(nodes_.place(node), 0.0), {}});
    }
    return junction_[node];
  }

  StreetGraph& graph_;
  const std::vector<std::uint32_t>& rows_;
  Nodes nodes_;
  std::vector<std::uint32_t> junction_, uses_;  // a row a node
};

}  // namespace

StreetGraph build_street_graph(std::vector<StreetFeature> streets, std::vector<Issue>& issues) {
  StreetGraph graph;
  graph.streets = std::move(streets);
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < graph.streets.size(); ++i) {
    const char* fault = fault_of(graph.streets[i]);
    if (fault != nullptr)
      issues.push_back({graph.streets[i].where, fault});
    else if (!graph.streets[i].tunnel)
      rows.push_back(i);
  }
  Cutter(graph, rows).run(issues);
  raise_streets(graph);
  return graph;
}

}  // namespace manzana
