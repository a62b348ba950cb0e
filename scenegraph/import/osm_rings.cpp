#include "scenegraph/import/osm_rings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manzana {
namespace {

constexpr double kLeastWidth = 0.01;  // metres: OpenStreetMap's coordinates have steps of 1 cm

using Ring = std::vector<Vec2d>;

/// Joins ways into rings; lives for one relation and one role.
class RingJoiner {
 public:
  RingJoiner(std::vector<MemberWay>& ways, const std::string& where, std::vector<Issue>& issues)
      : ways_(ways), used_(ways.size(), false), where_(where), issues_(issues) {}

  std::vector<Ring> run() {
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      if (ways_[i].closed) continue;
      ends_.emplace(ways_[i].line.nodes.front(), i);
      ends_.emplace(ways_[i].line.nodes.back(), i);
    }
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      if (!used_[i]) finish(grow(i));
    }
    return std::move(rings_);
  }

 private:
  OsmLine grow(std::size_t first) {
    used_[first] = true;
    OsmLine line = std::move(ways_[first].line);
    if (ways_[first].closed) return line;
    while (line.nodes.front() != line.nodes.back()) {
      const auto next = way_at(line.nodes.back());
      if (!next) break;
      append(line, *next);
    }
    closed_ = line.nodes.front() == line.nodes.back();
    return line;
  }

  /// An unused way that ends there.
  std::optional<std::size_t> way_at(std::int64_t node) {
    for (auto [at, end] = ends_.equal_range(node); at != end; at = ends_.erase(at)) {
      if (!used_[at->second]) return at->second;
    }
    return std::nullopt;
  }

  void append(OsmLine& line, std::size_t way) {
    used_[way] = true;
    OsmLine next = std::move(ways_[way].line);
    if (next.nodes.front() != line.nodes.back()) {
      std::ranges::reverse(next.nodes);
      std::ranges::reverse(next.points);
    }
    line.nodes.insert(line.nodes.end(), next.nodes.begin() + 1, next.nodes.end());
    line.points.insert(line.points.end(), next.points.begin() + 1, next.points.end());
  }

  void finish(OsmLine line) {
    const bool closed = std::exchange(closed_, true);
    if (!closed) return complain("ring is not closed");
    clean_ring(line.points);
    if (line.points.size() < 3) return complain("ring has fewer than three corners");
    if (!has_width(line.points)) return complain("ring has no area");
    rings_.push_back(std::move(line.points));
  }

  void complain(const char* what) { issues_.push_back({where_, what}); }

  std::vector<MemberWay>& ways_;
  std::vector<bool> used_;
  const std::string& where_;
  std::vector<Issue>& issues_;
  std::unordered_multimap<std::int64_t, std::size_t> ends_;
  std::vector<Ring> rings_;
  bool closed_ = true;
};

/// A hole may share corners with its outer ring, so the better part of some of its corners decides.
bool holds(const Ring& outer, const Ring& hole) {
  constexpr std::size_t kAsked = 9;
  const std::size_t step = std::max<std::size_t>(hole.size() / kAsked, 1);
  std::size_t asked = 0, inside = 0;
  for (std::size_t i = 0; i < hole.size(); i += step, ++asked) inside += contains(outer, hole[i]) ? 1 : 0;
  return 2 * inside >= asked;
}

/// The smallest outer ring that holds the hole.
Polygon* holder(std::vector<Polygon>& outers, const Ring& hole) {
  Polygon* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Polygon& outer : outers) {
    const double area = std::abs(twice_area(outer.outer));
    if (area >= least || !holds(outer.outer, hole)) continue;
    least = area;
    best = &outer;
  }
  return best;
}

}  // namespace

std::vector<Polygon> assemble_rings(MemberWays& members, const std::string& where, std::vector<Issue>& issues) {
  std::vector<Polygon> shapes;
  for (Ring& ring : RingJoiner(members.outer, where, issues).run()) shapes.push_back({std::move(ring), {}});
  if (shapes.empty()) {
    issues.push_back({where, "no outer ring"});
    return shapes;
  }
  for (Ring& hole : RingJoiner(members.inner, where, issues).run()) {
    Polygon* outer = holder(shapes, hole);
    if (outer != nullptr) outer->holes.push_back(std::move(hole));
    if (outer == nullptr) issues.push_back({where, "inner ring lies outside the outer rings"});
  }
  return shapes;
}

void clean_ring(std::vector<Vec2d>& ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

bool has_width(std::span<const Vec2d> ring) {
  const auto distance = [&](const Vec2d& p) { return glm::length(p - ring[0]); };
  const Vec2d far = *std::ranges::max_element(ring, {}, distance);
  const double length = distance(far);
  if (!(length > kLeastWidth)) return false;
  const Vec2d along = (far - ring[0]) / length;
  return std::ranges::any_of(ring, [&](const Vec2d& p) {
    const Vec2d d = p - ring[0];
    return std::abs(along.x * d.y - along.y * d.x) > kLeastWidth;
  });
}

}  // namespace manzana
