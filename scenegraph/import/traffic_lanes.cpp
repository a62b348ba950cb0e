#include "scenegraph/import/traffic_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace manzana {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBendRadius = 9;      // metres, of a street's own bends
constexpr double kKerbSideRadius = 7;  // of turns that must not cut the corner
constexpr double kKerbSideCut = 1.2;   // metres: by so much they may, if their radius is larger then
constexpr double kWideRadius = 18;     // of the others
constexpr double kWideCut = 4;
constexpr double kStopBack = 3.5;  // lanes end so far from where the kerbs meet: more than half a car
constexpr double kLongestTrim = 28;
constexpr double kStraightOn = 0.6;    // turns below this are S-curves from lane to lane
constexpr double kArcStep = kPi / 12;  // of a curve, from point to point

Vec2d plan(const Vec3d& p) { return {p.x, p.y}; }
double plan_distance(const Vec3d& a, const Vec3d& b) { return glm::distance(plan(a), plan(b)); }
Vec2d direction(const Vec3d& a, const Vec3d& b) { return glm::normalize(plan(b) - plan(a)); }
double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }
Vec2d rightwards(const Vec2d& d) { return {d.y, -d.x}; }

void push_distinct(std::vector<Vec3d>& line, const Vec3d& p) {
  if (line.empty() || plan_distance(line.back(), p) > 1e-3) line.push_back(p);
}

/// Quadratic Bézier curve from a to c with tangents through b; a included, c too.
void push_bend(std::vector<Vec3d>& line, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double turn = std::abs(turn_angle(direction(a, b), direction(b, c)));
  const int steps = std::max(2, static_cast<int>(std::ceil(turn / kArcStep)));
  for (int i = 0; i <= steps; ++i) {
    const double t = double(i) / steps;
    push_distinct(line, (1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c);
  }
}

/// Corners of more than a few degrees become curves.
std::vector<Vec3d> rounded(const std::vector<Vec3d>& line) {
  std::vector<Vec3d> out{line.front()};
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Vec3d &a = line[i - 1], &b = line[i], &c = line[i + 1];
    const double turn = std::abs(turn_angle(direction(a, b), direction(b, c)));
    const double ab = plan_distance(a, b), bc = plan_distance(b, c);
    const double reach = std::min({kBendRadius * std::tan(std::min(turn, 3.0) / 2), 0.45 * ab, 0.45 * bc});
    if (turn < 0.05)
      push_distinct(out, b);
    else
      push_bend(out, b + (a - b) * (reach / ab), b, b + (c - b) * (reach / bc));
  }
  push_distinct(out, line.back());
  return out;
}

Vec3d point_along(const std::vector<Vec3d>& line, double s) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = plan_distance(line[i - 1], line[i]);
    if (s <= step || i + 1 == line.size()) return glm::mix(line[i - 1], line[i], step > 0 ? s / step : 0.0);
    s -= step;
  }
  return line.back();
}

std::vector<Vec3d> cut(const std::vector<Vec3d>& line, double begin, double end) {
  std::vector<Vec3d> out{point_along(line, begin)};
  double s = 0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    s += plan_distance(line[i - 1], line[i]);
    if (s > begin + 0.05 && s < end - 0.05) push_distinct(out, line[i]);
  }
  out.push_back(point_along(line, end));
  return out;
}

/// The line moved to its right by d metres; points that would run backwards in a tight bend are left out.
std::vector<Vec3d> moved_right(const std::vector<Vec3d>& line, double d) {
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2d before = direction(line[i > 0 ? i - 1 : 0], line[i > 0 ? i : 1]);
    const Vec2d after = i + 1 < line.size() ? direction(line[i], line[i + 1]) : before;
    const double cos_half = std::sqrt(std::max(0.25, (1 + glm::dot(before, after)) / 2));
    const Vec2d sum = rightwards(before) + rightwards(after);
    const Vec2d side = glm::length(sum) > 1e-6 ? glm::normalize(sum) : rightwards(after);
    const Vec3d p = line[i] + Vec3d(side * (d / cos_half), 0);
    const bool backwards = !out.empty() && glm::dot(plan(p) - plan(out.back()), before) < 0.02;
    if (backwards && i + 1 < line.size()) continue;
    if (backwards && out.size() > 1) out.pop_back();
    out.push_back(p);
  }
  return out;
}

/// Metres from the street's middle to the middle of its lane at the kerb; a two-way street has two lanes at least.
double lane_offset(const StreetFeature& street) {
  const double lanes = std::clamp(street.lanes, street.one_way ? 1 : 2, 12);
  const double offset = street.width / 2 * (1 - 1 / lanes);
  return street.one_way ? offset : std::max(offset, 1.3);
}

double speed_limit(StreetClass kind) {
  switch (kind) {
    case StreetClass::motorway:
      return 25;
    case StreetClass::primary:
      return 14;
    case StreetClass::secondary:
      return 13;
    default:
      return 8.5;
  }
}

/// One end of an edge, at a junction.
struct Leg {
  std::uint32_t edge;
  bool far_end;  // the edge's last point is at the junction
  double angle;
  double half_width;
};

class LaneMaker {
 public:
  LaneMaker(const StreetGraph& graph, bool left_hand)
      : graph_(graph), side_(left_hand ? -1.0 : 1.0), trims_(2 * graph.edges.size(), 0) {}

  std::vector<Lane> run() {
    for (const Junction& junction : graph_.junctions) trim_legs(legs(junction));
    std::vector<Lane> lanes;
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e)
      if (carries_traffic(street(e).kind)) append_lanes(lanes, e);
    return lanes;
  }

 private:
  const StreetFeature& street(std::uint32_t edge) const { return graph_.streets[graph_.edges[edge].street]; }

  void append_leg(std::vector<Leg>& legs, std::uint32_t e, bool far_end) const {
    const StreetEdge& edge = graph_.edges[e];
    const double reach = std::min(8.0, edge.length / 2);
    const Vec3d corner = far_end ? edge.points.back() : edge.points.front();
    const Vec2d out = plan(point_along(edge.points, far_end ? edge.length - reach : reach)) - plan(corner);
    legs.push_back({e, far_end, std::atan2(out.y, out.x), std::clamp(street(e).width / 2, 2.0, 15.0)});
  }

  /// Round the junction, by angle; a loop has two.
  std::vector<Leg> legs(const Junction& junction) const {
    std::vector<Leg> out;
    std::vector<std::uint32_t> edges = junction.edges;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    const auto id = static_cast<std::uint32_t>(&junction - graph_.junctions.data());
    for (const std::uint32_t e : edges) {
      if (!carries_traffic(street(e).kind)) continue;
      if (graph_.edges[e].from == id) append_leg(out, e, false);
      if (graph_.edges[e].to == id) append_leg(out, e, true);
    }
    std::sort(out.begin(), out.end(), [](const Leg& a, const Leg& b) { return a.angle < b.angle; });
    return out;
  }

  void trim_legs(const std::vector<Leg>& legs) {
    if (legs.size() == 1) trim(legs[0]) = lane_offset(street(legs[0].edge)) + 1;
    if (legs.size() < 2) return;
    const double bend = std::abs(kPi - std::abs(legs[1].angle - legs[0].angle));
    const double back = legs.size() > 2 || bend > 0.3 ? kStopBack : 0.5;
    for (const Leg& leg : legs) trim(leg) = back;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const Leg &a = legs[i], &b = legs[(i + 1) % legs.size()];
      double gap = b.angle - a.angle;
      if (gap <= 0) gap += 2 * kPi;
      if (gap >= kPi) continue;
      const double kerbs_meet = std::max(a.half_width, b.half_width) / std::tan(gap / 2);
      for (const Leg& leg : {a, b}) trim(leg) = std::max(trim(leg), std::min(kerbs_meet + back, kLongestTrim));
    }
  }

  double& trim(const Leg& leg) { return trims_[2 * leg.edge + (leg.far_end ? 1 : 0)]; }

  void append_lanes(std::vector<Lane>& lanes, std::uint32_t e) const {
    const StreetEdge& edge = graph_.edges[e];
    const std::vector<Vec3d> middle = rounded(edge.points);
    const double length = plan_length(middle);
    const double most = length - std::min(2.0, 0.3 * length);
    const double trims = trims_[2 * e] + trims_[2 * e + 1], scale = trims > most ? most / trims : 1;
    std::vector<Vec3d> line = cut(middle, trims_[2 * e] * scale, length - trims_[2 * e + 1] * scale);
    append_lane(lanes, e, false, line);
    if (street(e).one_way) return;
    std::reverse(line.begin(), line.end());
    append_lane(lanes, e, true, line);
  }

  void append_lane(std::vector<Lane>& lanes, std::uint32_t e, bool against, const std::vector<Vec3d>& line) const {
    const StreetEdge& edge = graph_.edges[e];
    Lane lane{e, against, against ? edge.to : edge.from, against ? edge.from : edge.to, {}, 0, 0};
    lane.line = moved_right(line, side_ * lane_offset(street(e)));
    lane.length = plan_length(lane.line);
    lane.speed = speed_limit(street(e).kind);
    lanes.push_back(std::move(lane));
  }

  const StreetGraph& graph_;
  double side_;
  std::vector<double> trims_;  // 2 an edge: at its first and its last point
};

/// Handles of `reach` metres, tangent to both lanes.
std::vector<Vec3d> cubic(const Vec3d& a, const Vec3d& b, const Vec2d& from, const Vec2d& to, double reach) {
  std::vector<Vec3d> line{a};
  const double bend = std::abs(turn_angle(from, direction(a, b))) + std::abs(turn_angle(direction(a, b), to));
  const int steps = std::clamp(static_cast<int>(std::ceil(bend / kArcStep)) + 3, 5, 16);
  const Vec3d p = a + Vec3d(from * reach, 0), q = b - Vec3d(to * reach, 0);
  for (int i = 1; i < steps; ++i) {
    const double t = double(i) / steps, u = 1 - t;
    push_distinct(line, u * u * u * a + 3 * u * u * t * p + 3 * u * t * t * q + t * t * t * b);
  }
  push_distinct(line, b);
  return line;
}

std::vector<Vec3d> half_circle(const Vec3d& a, const Vec3d& b, const Vec2d& from) {
  std::vector<Vec3d> line{a};
  const Vec3d center = (a + b) * 0.5;
  const double radius = plan_distance(a, b) / 2;
  constexpr int kSteps = 12;
  for (int i = 1; i < kSteps; ++i) {
    const double angle = kPi * i / kSteps;
    push_distinct(line, center + (a - center) * std::cos(angle) + Vec3d(from * (radius * std::sin(angle)), 0));
  }
  push_distinct(line, b);
  return line;
}

double bend_radius(double turn, bool left_hand) {
  const bool kerb_side = (turn < 0) != left_hand;
  const double cut = 1 / std::cos(turn / 2) - 1;  // of the corner, by a circle of radius 1
  return kerb_side ? std::max(kKerbSideRadius, kKerbSideCut / cut) : std::max(kWideRadius, kWideCut / cut);
}

/// Heights rise evenly from end to end.
std::vector<Vec3d> level(std::vector<Vec3d> line) {
  const double length = plan_length(line), first = line.front().z, rise = line.back().z - first;
  double s = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    s += plan_distance(line[i - 1], line[i]);
    line[i].z = first + rise * s / length;
  }
  return line;
}

}  // namespace

Vec2d start_direction(const Lane& lane) { return direction(lane.line[0], lane.line[1]); }
Vec2d end_direction(const Lane& lane) { return direction(lane.line[lane.line.size() - 2], lane.line.back()); }
double turn_angle(const Vec2d& a, const Vec2d& b) { return std::atan2(cross(a, b), glm::dot(a, b)); }

double plan_length(std::span<const Vec3d> line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += plan_distance(line[i - 1], line[i]);
  return sum;
}

double bend_speed(std::span<const Vec3d> line, std::size_t i) {
  if (i == 0 || i + 1 >= line.size()) return std::numeric_limits<double>::infinity();
  const double turn = std::abs(turn_angle(direction(line[i - 1], line[i]), direction(line[i], line[i + 1])));
  if (turn < 1e-3) return std::numeric_limits<double>::infinity();
  const double radius = plan_distance(line[i - 1], line[i + 1]) / (2 * std::sin(std::min(turn, kPi / 2)));
  return std::max(kSlowest, std::sqrt(kSideAcceleration * radius));
}

std::vector<Lane> make_lanes(const StreetGraph& graph, bool left_hand) { return LaneMaker(graph, left_hand).run(); }

std::vector<Vec3d> way_over_junction(const Lane& in, const Lane& out, bool left_hand) {
  const Vec3d a = in.line.back(), b = out.line.front();
  const Vec2d from = end_direction(in), to = start_direction(out);
  const double distance = plan_distance(a, b), turn = turn_angle(from, to);
  if (distance < 1e-3) return {a, b + Vec3d(to * 1e-3, 0)};
  if (in.edge == out.edge && in.to == out.from && in.against != out.against && distance > 1)
    return half_circle(a, b, from);
  const double sine = cross(from, to);
  const double before = cross(plan(b) - plan(a), to) / sine, after = cross(from, plan(b) - plan(a)) / sine;
  const bool meet = std::abs(turn) > kStraightOn && std::abs(turn) < 2.6 && before > 0.2 && after > 0.2;
  if (!meet) return level(cubic(a, b, from, to, distance * (std::abs(turn) < 2 ? 0.35 : 0.6)));
  const double reach = std::min({before, after, bend_radius(turn, left_hand) * std::tan(std::abs(turn) / 2)});
  const Vec3d corner = a + Vec3d(from * before, 0);
  std::vector<Vec3d> line{a};
  push_bend(line, corner - Vec3d(from * reach, 0), corner, corner + Vec3d(to * reach, 0));
  push_distinct(line, b);
  line.back() = b;
  return level(std::move(line));
}

}  // namespace manzana
