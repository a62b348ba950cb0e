#include "apps/walkthrough/street_walk.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>

#include "apps/walkthrough/camera_path.h"

namespace manzana::walkthrough {
namespace {

// A state of the search is 2 * half + against, and is left by its end.
constexpr double kJunctionReach = 20;  // metres between the end of one street and the beginning of the next
constexpr double kTurnCost = 40;       // metres, of turning back
constexpr double kAgainst = 1.5;       // a metre against the traffic costs so much; routes are walked towards the start
constexpr std::uint32_t kNone = ~0U;

struct Line {
  const Traffic& traffic;
  std::span<const LanePoint> points(std::uint32_t state) const {
    const HalfStreet& half = traffic.halves[state / 2];
    return std::span(traffic.points).subspan(half.first_point, half.last_point - half.first_point);
  }
  bool against(std::uint32_t state) const { return state % 2 == 1; }
  Vec2d begin(std::uint32_t state) const {
    return Vec2d(against(state) ? points(state).back().position : points(state).front().position);
  }
  Vec2d end(std::uint32_t state) const { return begin(state ^ 1U); }
  double cost(std::uint32_t state) const { return points(state).back().s * (against(state) ? 1.0 : kAgainst); }
  /// Unit direction of travel at its beginning.
  Vec2d heading(std::uint32_t state) const {
    const auto p = points(state);
    const Vec2d d =
        against(state) ? Vec2d(p[p.size() - 2].position - p.back().position) : Vec2d(p[1].position - p[0].position);
    return glm::length(d) > 0 ? glm::normalize(d) : Vec2d(1, 0);
  }
};

double turn_cost(const Vec2d& before, const Vec2d& after) { return kTurnCost * (1 - glm::dot(before, after)) / 2; }

PlanGrid begin_grid(const Line& line, std::uint32_t states) {
  PlanGrid grid(kJunctionReach);
  for (std::uint32_t s = 0; s < states; ++s) grid.add(line.begin(s), line.begin(s), s);
  grid.finish();
  return grid;
}

std::uint32_t nearest_state(const Line& line, std::uint32_t states, const Vec2d& place) {
  std::uint32_t best = kNone;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::uint32_t s = 0; s < states; ++s)
    if (const double d = glm::distance(line.begin(s), place); d < best_distance) best_distance = d, best = s;
  return best;
}

}  // namespace

StreetSearch::StreetSearch(const Traffic& traffic, const Vec2d& place) : traffic_(traffic), start_(place) {
  const Line line{traffic};
  const auto states = static_cast<std::uint32_t>(traffic.halves.size() * 2);
  cost_.assign(states, std::numeric_limits<double>::infinity());
  parent_.assign(states, kNone);
  if (states == 0) return;
  const PlanGrid grid = begin_grid(line, states);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> todo;
  const auto reach = [&](std::uint32_t state, double cost, std::uint32_t parent) {
    if (cost >= cost_[state]) return;
    cost_[state] = cost;
    parent_[state] = parent;
    todo.push({cost, state});
  };
  start_ = line.begin(nearest_state(line, states, place));
  grid.visit(start_, kJunctionReach, [&](std::uint32_t s) {
    if (glm::distance(line.begin(s), start_) <= kJunctionReach) reach(s, line.cost(s), kNone);
  });
  while (!todo.empty()) {
    const double cost = todo.top().first;
    const std::uint32_t state = todo.top().second;
    todo.pop();
    if (cost > cost_[state]) continue;
    const Vec2d end = line.end(state), heading = -line.heading(state ^ 1U);
    grid.visit(end, kJunctionReach, [&](std::uint32_t next) {
      const double hop = glm::distance(line.begin(next), end);
      if (hop > kJunctionReach || next / 2 == state / 2) return;
      reach(next, cost + hop + line.cost(next) + turn_cost(heading, line.heading(next)), state);
    });
  }
}

std::vector<StreetSearch::End> StreetSearch::ends() const {
  std::vector<End> out;
  for (std::uint32_t s = 0; s < cost_.size(); ++s)
    if (cost_[s] < std::numeric_limits<double>::infinity())
      out.push_back({s, cost_[s], glm::distance(Line{traffic_}.end(s), start_)});
  return out;
}

StreetRoute StreetSearch::route_from(std::uint32_t state) const {
  StreetRoute route;
  for (std::uint32_t s = state; s != kNone; s = parent_[s]) route.push_back({s / 2, s % 2 == 0});
  return route;
}

std::vector<StreetRoute> straight_routes(const StreetSearch& search, double farthest_m, std::size_t most) {
  auto ends = search.ends();
  std::erase_if(ends, [&](const auto& end) { return end.distance > farthest_m || !(end.distance > 0); });
  double farthest = 0;
  for (const auto& end : ends) farthest = std::max(farthest, end.distance);
  std::erase_if(ends, [&](const auto& end) { return end.distance < farthest / 2; });
  std::sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) {
    return std::pair(a.cost / a.distance, a.state) < std::pair(b.cost / b.distance, b.state);
  });
  ends.resize(std::min(ends.size(), most));
  std::vector<StreetRoute> routes;
  for (const auto& end : ends) routes.push_back(search.route_from(end.state));
  return routes;
}

StreetRoute route_of_length(const StreetSearch& search, double length_m) {
  const auto ends = search.ends();
  const auto best = std::min_element(ends.begin(), ends.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.cost - length_m) < std::abs(b.cost - length_m);
  });
  return best == ends.end() ? StreetRoute{} : search.route_from(best->state);
}

std::vector<Vec3d> resample(std::span<const Vec3d> line, double step_m) {
  std::vector<Vec3d> out;
  if (line.empty()) return out;
  out.push_back(line.front());
  double left = step_m;  // until the next point
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double length = glm::distance(line[i], line[i + 1]);
    double at = left;
    for (; at < length; at += step_m) out.push_back(glm::mix(line[i], line[i + 1], at / length));
    left = at - length;
  }
  if (glm::distance(out.back(), line.back()) > step_m / 2 || out.size() == 1)
    out.push_back(line.back());
  else
    out.back() = line.back();
  return out;
}

namespace {

constexpr double kEye = 1.7;     // metres above the feet
constexpr double kMargin = 0.7;  // from walls and trunks

/// +1 where traffic keeps right, -1 where it keeps left: a half-street's block lies on its kerb side.
double kerb_side(const Scene& scene) {
  double vote = 0;
  for (const HalfStreet& half : scene.traffic.halves) {
    const Vec3d a = scene.traffic.points[half.first_point].position;
    const Vec3d along = scene.traffic.points[half.last_point - 1].position - a;
    const Vec3d to_block = scene.blocks[half.block].origin - a;
    vote += to_block.x * along.y - to_block.y * along.x > 0 ? 1 : -1;
  }
  return vote >= 0 ? 1 : -1;
}

/// A point of the lane, moved to the pavement as far as it is clear there.
Vec3d step_aside(const Obstacles& obstacles, const Vec3d& lane, const Vec3d& to_kerb) {
  for (const double aside : {3.2, 2.4, 1.6, 0.8}) {
    const Vec3d feet = lane + to_kerb * aside;
    if (obstacles.clear(feet + Vec3d(0, 0, kEye), kMargin)) return feet;
  }
  return lane;
}

void append_step(const Scene& scene, const Obstacles& obstacles, const StreetStep& step, double side,
                 std::vector<Vec3d>& feet) {
  constexpr double kStride = 5;
  const HalfStreet& half = scene.traffic.halves[step.half];
  std::vector<Vec3d> lane;
  for (std::uint32_t i = half.first_point; i < half.last_point; ++i)
    lane.push_back(to_ground(scene.frame, scene.traffic.points[i].position));
  lane = resample(lane, kStride);
  std::vector<Vec3d> moved;
  for (std::size_t i = 0; i < lane.size(); ++i) {
    const Vec3d along = lane[std::min(i + 1, lane.size() - 1)] - lane[i > 0 ? i - 1 : 0];
    const double length = std::hypot(along.x, along.y);
    const Vec3d kerb = length > 0 ? Vec3d(along.y, -along.x, 0) * (side / length) : Vec3d(0, 0, 0);
    moved.push_back(step_aside(obstacles, lane[i], kerb));
  }
  if (step.against) std::reverse(moved.begin(), moved.end());
  feet.insert(feet.end(), moved.begin(), moved.end());
}

/// Means of three neighbours, where that goes through nothing.
std::vector<Vec3d> round_corners(const Obstacles& obstacles, const std::vector<Vec3d>& line) {
  std::vector<Vec3d> out = line;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Vec3d mean = (line[i - 1] + 2.0 * line[i] + line[i + 1]) / 4.0;
    if (obstacles.clear(mean + Vec3d(0, 0, kEye), kMargin)) out[i] = mean;
  }
  return out;
}

/// The nearest clear place beside a point of a way that leads to `along`; the point itself when there is none.
Vec3d push_aside(const Obstacles& obstacles, const Vec3d& feet, const Vec3d& along) {
  const double length = std::hypot(along.x, along.y);
  if (!(length > 0) || obstacles.clear(feet + Vec3d(0, 0, kEye), kMargin)) return feet;
  const Vec3d across = Vec3d(along.y, -along.x, 0) / length;
  for (double by = 0.5; by <= 8; by += 0.5)
    for (const double side : {-by, by})
      if (obstacles.clear(feet + across * side + Vec3d(0, 0, kEye), kMargin)) return feet + across * side;
  return feet;
}

/// Ways across corners, between streets, may still cut a wall: their points and middles are pushed off it.
std::vector<Vec3d> push_off_walls(const Obstacles& obstacles, const std::vector<Vec3d>& line) {
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3d along = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    const Vec3d here = push_aside(obstacles, line[i], along);
    if (!out.empty()) {
      const Vec3d middle = (out.back() + here) / 2.0;
      if (!obstacles.clear(middle + Vec3d(0, 0, kEye), kMargin)) out.push_back(push_aside(obstacles, middle, along));
    }
    out.push_back(here);
  }
  return out;
}

}  // namespace

std::vector<Vec3d> walk_along(const Scene& scene, const Obstacles& obstacles, const StreetRoute& route, double step_m) {
  const double side = route.empty() ? 1 : kerb_side(scene);
  std::vector<Vec3d> feet;
  for (const StreetStep& step : route) append_step(scene, obstacles, step, side, feet);
  feet = resample(feet, step_m);
  for (int pass = 0; pass < 3; ++pass) feet = round_corners(obstacles, feet);
  return push_off_walls(obstacles, feet);
}

}  // namespace manzana::walkthrough
