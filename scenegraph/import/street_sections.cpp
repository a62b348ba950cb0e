#include "scenegraph/import/street_sections.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenegraph/import/plan_geometry.h"

namespace manzana {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSharp = 100 * kPi / 180;     // bends beyond this are not mitred: the spike would be 1.6 widths long
constexpr double kStraight = 150 * kPi / 180;  // two arms further apart than this are one street
constexpr double kShortest = 0.5;              // metres; nearer points are one
constexpr double kBow = 0.05;                  // metres; less than this is straight

Vec2d right_of(const Vec2d& d) { return {d.y, -d.x}; }

bool straight(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec2d in(b - a), all(c - a);
  const double length = glm::length(all);
  if (!(length > 0) || glm::dot(in, Vec2d(c - b)) <= 0) return false;
  const double t = glm::dot(in, all) / (length * length);
  return std::abs(plan::cross(in, all)) < kBow * length && std::abs(a.z + (c.z - a.z) * t - b.z) < kBow;
}

std::vector<Vec3d> tidied(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> kept{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const bool close = glm::distance(Vec2d(points[i]), Vec2d(kept.back())) < kShortest;
    if (!close && !straight(kept.back(), points[i], points[i + 1])) kept.push_back(points[i]);
  }
  while (kept.size() > 1 && glm::distance(Vec2d(points.back()), Vec2d(kept.back())) < kShortest) kept.pop_back();
  kept.push_back(points.back());
  return kept;
}

bool usable(const StreetEdge& edge, const StreetFeature& street) {
  const bool good = std::all_of(edge.points.begin(), edge.points.end(), [](const Vec3d& p) {
    return std::abs(p.x) < 1e7 && std::abs(p.y) < 1e7 && std::abs(p.z) < 1e4;
  });
  return good && edge.points.size() >= 2 && std::isfinite(street.width) &&
         glm::distance(Vec2d(edge.points.front()), Vec2d(edge.points[1])) > 0;
}

/// An edge's end at a junction, seen from there.
struct Arm {
  std::uint32_t edge = 0;
  int end = 0;
  Vec2d out{1, 0};
  double angle = 0, length = 0, half = 0, pavement = 0;
  StreetClass kind = StreetClass::residential;
  int mate = -1;  // end of the edge that goes on from here, as 2 * edge + end
  int name() const { return 2 * static_cast<int>(edge) + end; }
};

double between(const Arm& a, const Arm& b) {
  return std::abs(std::atan2(plan::cross(a.out, b.out), glm::dot(a.out, b.out)));
}

Arm arm_of(const StreetGraph& graph, const std::vector<StreetLine>& lines, std::uint32_t edge, int end) {
  const StreetLine& line = lines[edge];
  const StreetFeature& street = graph.streets[graph.edges[edge].street];
  const std::size_t n = line.points.size();
  const Vec2d first(line.points[end == 0 ? 0 : n - 1]), second(line.points[end == 0 ? 1 : n - 2]);
  Arm arm{edge, end, second - first, 0, glm::distance(first, second), line.half_width, 0, street.kind};
  arm.out /= arm.length;
  arm.angle = std::atan2(arm.out.y, arm.out.x);
  arm.pavement = street_look(street.kind).pavement;
  return arm;
}

/// Metres of arm a that lie within arm b: where their edges cross.
double covered(const Arm& a, const Arm& b) {
  const double angle = between(a, b), most = 3 * std::max(a.half, b.half);
  if (std::sin(angle) < 0.1) return angle < 1 ? most : 0;
  return std::clamp((b.half + a.half * std::cos(angle)) / std::sin(angle), 0.0, most);
}

/// The main street at a turning-off keeps its lines.
bool runs_through(const std::vector<Arm>& arms, const Arm& a) {
  bool continued = false;
  for (const Arm& b : arms) {
    if (&b == &a) continue;
    if (b.kind == a.kind && between(a, b) > kStraight) {
      continued = true;
    } else if (b.kind < a.kind || (b.kind == a.kind && arms.size() != 3)) {
      return false;
    }
  }
  return continued;
}

void set_clearances(const std::vector<Arm>& arms, std::vector<StreetLine>& lines) {
  for (const Arm& a : arms) {
    EdgeEnd& end = lines[a.edge].ends[static_cast<std::size_t>(a.end)];
    const bool through = runs_through(arms, a);
    for (const Arm& b : arms) {
      if (&b == &a || between(a, b) > kStraight) continue;
      end.open = std::max(end.open, covered(a, b) + 0.5);
      if (!through && b.kind <= a.kind) end.clear = std::max(end.clear, covered(a, b) + 1);
    }
    if (!through) end.clear = std::max(end.clear, a.half);
  }
}

/// Closes what is open by more than half a turn between neighbouring arms.
void add_wedges(std::vector<Arm>& arms, const Vec3d& center, std::vector<StreetLine>& lines) {
  std::sort(arms.begin(), arms.end(), [](const Arm& a, const Arm& b) { return a.angle < b.angle; });
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Arm &a = arms[i], &b = arms[(i + 1) % arms.size()];
    const double gap = b.angle - a.angle + (i + 1 == arms.size() ? 2 * kPi : 0);
    if (gap < kPi + 0.02 || a.mate == b.name()) continue;  // mitred ribbons leave no wedge
    const double pavement = std::min(a.pavement, b.pavement);
    lines[a.edge].wedges.push_back({center, a.angle + kPi / 2, a.angle + gap - kPi / 2, a.half, b.half, pavement});
  }
}

void mitre(Arm& own, const Arm& other, std::vector<StreetLine>& lines) {
  own.mate = other.name();
  EdgeEnd& end = lines[own.edge].ends[static_cast<std::size_t>(own.end)];
  end.continued = true;
  end.beyond = own.end == 0 ? -other.out : other.out;
  end.beyond_length = other.length;
}

/// Pairs of arms that are one street: both of a bend, and those of one kind that go straight on at a junction.
void mitre_pairs(std::vector<Arm>& arms, std::vector<StreetLine>& lines) {
  for (;;) {
    double best = arms.size() == 2 ? kPi - kSharp : kStraight;
    Arm *first = nullptr, *second = nullptr;
    for (std::size_t i = 0; i < arms.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        Arm &a = arms[i], &b = arms[j];
        const bool alike = arms.size() == 2 || a.kind == b.kind;
        if (a.mate >= 0 || b.mate >= 0 || !alike || between(a, b) <= best) continue;
        best = between(a, b);
        first = &a;
        second = &b;
      }
    if (first == nullptr) return;
    mitre(*first, *second, lines);
    mitre(*second, *first, lines);
  }
}

void join(std::vector<Arm>& arms, const Junction& junction, std::vector<StreetLine>& lines) {
  mitre_pairs(arms, lines);
  if (arms.empty() || (arms.size() == 2 && arms[0].mate >= 0)) return;
  const bool road = carries_traffic(arms[0].kind) || arms[0].kind == StreetClass::service;
  if (arms.size() == 1 && (!road || junction.edges.size() > 1)) return;  // paths end flat
  if (road && arms.size() > 1) set_clearances(arms, lines);
  add_wedges(arms, junction.position, lines);
}

void join_all(const StreetGraph& graph, std::vector<StreetLine>& lines) {
  for (std::uint32_t j = 0; j < graph.junctions.size(); ++j) {
    std::vector<Arm> roads, walks;
    for (const std::uint32_t e : graph.junctions[j].edges) {
      if (!lines[e].laid) continue;
      auto& arms = street_look(graph.streets[graph.edges[e].street].kind).road ? roads : walks;
      const bool loop = graph.edges[e].from == graph.edges[e].to;
      const bool second = loop && std::any_of(arms.begin(), arms.end(), [e](const Arm& a) { return a.edge == e; });
      arms.push_back(arm_of(graph, lines, e, loop ? second : graph.edges[e].to == j));
    }
    join(roads, graph.junctions[j], lines);
    join(walks, graph.junctions[j], lines);
  }
}

}  // namespace

StreetLook street_look(StreetClass kind) {
  switch (kind) {
    case StreetClass::motorway:
      return {Material::asphalt, 0.136, 0, true};
    case StreetClass::primary:
      return {Material::asphalt, 0.132, 2.5, true};
    case StreetClass::secondary:
      return {Material::asphalt, 0.128, 2.2, true};
    case StreetClass::residential:
      return {Material::asphalt, 0.124, 1.8, true};
    case StreetClass::service:
      return {Material::asphalt, 0.120, 0, true};
    case StreetClass::pedestrian:
      return {Material::pavement, 0.084, 0, false};
    case StreetClass::track:
      return {Material::path, 0.064, 0, false};
    default:
      return {Material::path, 0.060, 0, false};
  }
}

Vec2d Section::at(double s) const { return center + right * std::clamp(s * stretch, -most_left, most_right); }

double length_in_plan(std::span<const Vec3d> points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(Vec2d(points[i - 1]), Vec2d(points[i]));
  return sum;
}

std::vector<StreetLine> street_lines(const StreetGraph& graph, std::vector<Issue>& issues) {
  std::vector<StreetLine> lines(graph.edges.size());
  for (std::size_t e = 0; e < lines.size(); ++e) {
    const StreetFeature& street = graph.streets[graph.edges[e].street];
    lines[e].laid = usable(graph.edges[e], street);
    if (!lines[e].laid) {
      issues.push_back({street.where, "a coordinate or width is not finite"});
      continue;
    }
    lines[e].points = tidied(graph.edges[e].points);
    lines[e].half_width = std::clamp(street.width, 0.5, 60.0) / 2;
    lines[e].laid = !(street.circular && !carries_traffic(street.kind));
  }
  join_all(graph, lines);
  return lines;
}

namespace {

struct Node {
  Vec3d point;
  double along;
};

std::vector<Node> cut_line(const std::vector<Vec3d>& points, std::span<const double> cuts, double nearness) {
  std::vector<Node> nodes{{points[0], 0}};
  std::size_t next = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double from = nodes.back().along, step = glm::distance(Vec2d(points[i - 1]), Vec2d(points[i]));
    double last = from;
    for (; next < cuts.size() && cuts[next] < from + step; ++next) {
      if (cuts[next] < last + nearness || cuts[next] > from + step - nearness) continue;
      nodes.push_back({points[i - 1] + (points[i] - points[i - 1]) * ((cuts[next] - from) / step), cuts[next]});
      last = cuts[next];
    }
    nodes.push_back({points[i], from + step});
  }
  return nodes;
}

/// How the line passes a node: directions of travel before and after, and the lengths that a mitre may take up.
struct Passage {
  Vec2d in, out;
  double before, after;
  double bend() const { return std::atan2(plan::cross(in, out), glm::dot(in, out)); }
};

Passage passage(const StreetLine& line, const std::vector<Node>& nodes, std::size_t i) {
  const auto step = [&](std::size_t k) { return Vec2d(nodes[k + 1].point - nodes[k].point); };
  const std::size_t last = nodes.size() - 1;
  const Vec2d before = step(i > 0 ? i - 1 : 0), after = step(i < last ? i : last - 1);
  Passage p{glm::normalize(before), glm::normalize(after), glm::length(before), glm::length(after)};
  const EdgeEnd& end = line.ends[i == 0 ? 0 : 1];
  if (i == 0 && end.continued) {
    p.in = end.beyond;
    p.before = end.beyond_length;
  } else if (i == last && end.continued) {
    p.out = end.beyond;
    p.after = end.beyond_length;
  }
  return p;
}

Section section(const Node& node, const Passage& p) {
  const Vec2d middle = glm::normalize(right_of(p.in) + right_of(p.out));
  const double cosine = glm::dot(middle, right_of(p.in));
  Section s{Vec2d(node.point), node.point.z, node.along, middle, 1 / cosine};
  const double half_sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  if (half_sine > 1e-3) (p.bend() > 0 ? s.most_left : s.most_right) = 0.49 * std::min(p.before, p.after) / half_sine;
  return s;
}

double grade(const std::vector<Node>& nodes, std::size_t i) {
  const std::size_t k = std::min(i, nodes.size() - 2);
  return (nodes[k + 1].point.z - nodes[k].point.z) / (nodes[k + 1].along - nodes[k].along);
}

/// The outer side of a sharp bend.
Wedge bend_wedge(const Node& node, const Passage& p, double half_width, double pavement) {
  const double bend = p.bend();
  const Vec2d first = bend > 0 ? right_of(p.in) : -right_of(p.out);
  const double a0 = std::atan2(first.y, first.x);
  return {node.point, a0, a0 + std::abs(bend), half_width, half_width, pavement};
}

}  // namespace

std::vector<Run> street_runs(StreetLine& line, std::span<const double> cuts, double pavement) {
  const std::vector<Node> nodes = cut_line(line.points, cuts, std::max(1.0, line.half_width));
  std::vector<Run> runs(1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Passage p = passage(line, nodes, i);
    const bool sharp = std::abs(p.bend()) > kSharp;
    runs.back().push_back(section(nodes[i], sharp ? Passage{p.in, p.in, p.before, p.before} : p));
    runs.back().back().grade = grade(nodes, i);
    if (!sharp) continue;
    runs.push_back({section(nodes[i], {p.out, p.out, p.after, p.after})});
    runs.back().back().grade = grade(nodes, i);
    line.wedges.push_back(bend_wedge(nodes[i], p, line.half_width, pavement));
  }
  return runs;
}

}  // namespace manzana
