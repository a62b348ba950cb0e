#include "scenegraph/import/bridge_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenegraph/import/geos.h"

namespace manzana {
namespace {

constexpr double kClearance = 2;        // metres of level deck beyond the edges of what is crossed
constexpr double kFlattestSine = 0.3;   // crossings at a smaller angle are taken for this one
constexpr std::size_t kWholeEdge = 16;  // longer edges are looked up segment by segment

struct Segment {
  Vec2d a, b;
  std::uint32_t edge = 0;
  double s = 0;  // of a, along the edge
};

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }
double side(const Segment& s, const Vec2d& p) { return cross(s.b - s.a, p - s.a); }
double length(const Vec2d& v) { return std::hypot(v.x, v.y); }

Segment segment(const StreetGraph& graph, std::uint32_t edge, std::size_t i, double s) {
  const auto& points = graph.edges[edge].points;
  return {Vec2d(points[i]), Vec2d(points[i + 1]), edge, s};
}

Geometry line(const Geos& geos, const Segment& s) { return geos.line(std::array{s.a, s.b}); }

// Closed: ends count.
bool on_segment(const Segment& s, const Vec2d& p) { return side(s, p) == 0 && glm::dot(p - s.a, p - s.b) <= 0; }

bool opposite(double a, double b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

class CrossingFinder {
 public:
  explicit CrossingFinder(const StreetGraph& graph) : graph_(graph), spans_(graph.edges.size()) {
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e)
      if (street(e).bridge) add_bridge(e);
  }

  std::vector<Span> run() {
    if (bridges_.empty()) return spans_;
    tree_ = GEOSSTRtree_create_r(geos_.handle(), 10);
    for (Segment& s : bridges_) {
      lines_.push_back(line(geos_, s));
      GEOSSTRtree_insert_r(geos_.handle(), tree_, lines_.back().get(), &s);
    }
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e)
      if (graph_.edges[e].points.size() > kWholeEdge || near_bridge(e)) look_below(e);
    GEOSSTRtree_destroy_r(geos_.handle(), tree_);
    return std::move(spans_);
  }

 private:
  const StreetFeature& street(std::uint32_t edge) const { return graph_.streets[graph_.edges[edge].street]; }

  void add_bridge(std::uint32_t e) {
    double s = 0;
    for (std::size_t i = 0; i + 1 < graph_.edges[e].points.size(); ++i) {
      bridges_.push_back(segment(graph_, e, i, s));
      s += length(bridges_.back().b - bridges_.back().a);
    }
  }

  bool near_bridge(std::uint32_t e) {
    const std::vector<Vec2d> plan(graph_.edges[e].points.begin(), graph_.edges[e].points.end());
    bool found = false;
    const auto any = [](void*, void* flag) { *static_cast<bool*>(flag) = true; };
    GEOSSTRtree_query_r(geos_.handle(), tree_, geos_.line(plan).get(), any, &found);
    return found;
  }

  void look_below(std::uint32_t e) {
    for (std::size_t i = 0; i + 1 < graph_.edges[e].points.size(); ++i) {
      lower_ = segment(graph_, e, i, 0);
      const auto meet = [](void* upper, void* self) {
        static_cast<CrossingFinder*>(self)->meet(*static_cast<const Segment*>(upper));
      };
      GEOSSTRtree_query_r(geos_.handle(), tree_, line(geos_, lower_).get(), meet, this);
    }
  }

  void meet(const Segment& upper) {
    if (upper.edge == lower_.edge || deck_layer(street(upper.edge)) <= deck_layer(street(lower_.edge))) return;
    const double a = side(upper, lower_.a), b = side(upper, lower_.b);
    if (opposite(a, b) && opposite(side(lower_, upper.a), side(lower_, upper.b))) {
      add(upper, glm::mix(lower_.a, lower_.b, a / (a - b)));
      return;
    }
    for (const Vec2d& p : {lower_.a, lower_.b})
      if (on_segment(upper, p) && !shared_junction(upper.edge, p)) add(upper, p);
    for (const Vec2d& p : {upper.a, upper.b})
      if (on_segment(lower_, p) && !shared_junction(upper.edge, p)) add(upper, p);
  }

  bool shared_junction(std::uint32_t upper, const Vec2d& p) const {
    const StreetEdge &u = graph_.edges[upper], &l = graph_.edges[lower_.edge];
    for (std::uint32_t j : {u.from, u.to})
      if ((j == l.from || j == l.to) && Vec2d(graph_.junctions[j].position) == p) return true;
    return false;
  }

  void add(const Segment& upper, const Vec2d& at) {
    const Vec2d u = upper.b - upper.a, l = lower_.b - lower_.a;
    const double sine = std::max(kFlattestSine, std::abs(cross(u / length(u), l / length(l))));
    const double width = street(lower_.edge).width;
    const double reach = (0.5 * (width > 0 && width < 100 ? width : 0.0) + kClearance) / sine;
    const double s = upper.s + length(at - upper.a), end = graph_.edges[upper.edge].length;
    Span& span = spans_[upper.edge];
    const Span here{std::max(0.0, s - reach), std::min(end, s + reach)};
    span = span.empty() ? here : Span{std::min(span.s0, here.s0), std::max(span.s1, here.s1)};
  }

  const StreetGraph& graph_;
  Geos geos_;
  std::vector<Segment> bridges_;
  std::vector<Geometry> lines_;
  GEOSSTRtree* tree_ = nullptr;
  std::vector<Span> spans_;
  Segment lower_;
};

}  // namespace

int deck_layer(const StreetFeature& street) {
  if (!street.bridge) return std::clamp(street.layer, -5, 0);
  return street.layer < 0 ? std::max(street.layer, -5) : std::clamp(street.layer, 1, 5);
}

std::vector<Span> spans_over_streets(const StreetGraph& graph) { return CrossingFinder(graph).run(); }

}  // namespace manzana
