#include "scenegraph/import/edge_collapse.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace manzana {
namespace {

constexpr double kTurn = 0.25;            // cosine between a triangle before and after, at least
constexpr double kLengthWeight = 1e-3;    // of two moves as good the shorter
constexpr double kHopeless = 4;           // errors from a plane about it
constexpr double kLeastTwiceArea = 1e-7;  // m2
constexpr double kInfinite = std::numeric_limits<double>::infinity();

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double size = glm::dot(along, along);
  const double t = size > 0 ? std::clamp(glm::dot(p - a, along) / size, 0.0, 1.0) : 0;
  return glm::length(p - (a + along * t));
}

void make_unique(std::vector<std::uint32_t>& items) {
  std::ranges::sort(items);
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace

EdgeCollapse::EdgeCollapse(std::vector<Vec3d> points, std::vector<Triangle> triangles)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      fixed_(points_.size(), false),
      fan_(points_.size()),
      stands_for_(points_.size()),
      on_course_(points_.size(), false) {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (const std::uint32_t c : triangles_[t].corner) fan_[c].push_back(t);
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    stands_for_[p] = {p};
    on_course_[p] = !course(p).empty();
  }
}

Vec3d EdgeCollapse::twice_area(const std::array<std::uint32_t, 3>& corner) const {
  const Vec3d& a = points_[corner[0]];
  return glm::cross(points_[corner[1]] - a, points_[corner[2]] - a);
}

bool EdgeCollapse::has(std::uint32_t triangle, std::uint32_t point) const {
  return std::ranges::find(triangles_[triangle].corner, point) != triangles_[triangle].corner.end();
}

/// Two triangles of one paint meet there.
bool EdgeCollapse::plain(std::uint32_t a, std::uint32_t b) const {
  std::size_t count = 0;
  std::uint32_t paint = 0;
  bool one = true;
  for (const std::uint32_t t : fan_[a]) {
    if (!has(t, b)) continue;
    one = one && (count == 0 || triangles_[t].paint == paint);
    paint = triangles_[t].paint;
    ++count;
  }
  return one && count == 2;
}

EdgeCollapse::Points EdgeCollapse::neighbours(std::uint32_t point) const {
  Points all;
  for (const std::uint32_t t : fan_[point])
    for (const std::uint32_t c : triangles_[t].corner)
      if (c != point) all.push_back(c);
  make_unique(all);
  return all;
}

EdgeCollapse::Points EdgeCollapse::course(std::uint32_t point) const {
  Points along = neighbours(point);
  std::erase_if(along, [&](std::uint32_t other) { return plain(point, other); });
  return along;
}

/// How far the planes about the point are from the other.
double EdgeCollapse::rank(const Move& move) const {
  double worst = 0;
  for (const std::uint32_t t : fan_[move.from]) {
    const Vec3d twice = twice_area(triangles_[t].corner);
    const double size = glm::length(twice);
    if (size > 0) worst = std::max(worst, std::abs(glm::dot(twice, points_[move.to] - points_[move.from])) / size);
  }
  return worst;
}

void EdgeCollapse::propose(std::uint32_t from, std::uint32_t to) {
  if (fixed_[from]) return;
  Move move{0, from, to};
  const double off = rank(move);
  move.rank = off + kLengthWeight * glm::distance(points_[from], points_[to]);
  if (off <= kHopeless * error_) moves_.push(move);
}

void EdgeCollapse::run(double error_m) {
  error_ = error_m;
  for (std::uint32_t p = 0; p < points_.size(); ++p)
    for (const std::uint32_t other : neighbours(p)) propose(p, other);
  while (!moves_.empty()) {
    const Move move = moves_.top();
    moves_.pop();
    if (possible(move)) apply(move);
  }
}

bool EdgeCollapse::possible(const Move& move) const {
  const Points around = neighbours(move.from), there = neighbours(move.to), along = course(move.from);
  if (!std::ranges::binary_search(around, move.to)) return false;
  if (!along.empty() && (along.size() != 2 || !std::ranges::binary_search(along, move.to))) return false;
  Points shared, opposite;
  std::ranges::set_intersection(around, there, std::back_inserter(shared));
  for (const std::uint32_t t : fan_[move.from])
    if (has(t, move.to))
      for (const std::uint32_t c : triangles_[t].corner)
        if (c != move.from && c != move.to) opposite.push_back(c);
  make_unique(opposite);
  return shared == opposite && keeps_sides(move) && keeps_near(move) && (along.empty() || keeps_course(move));
}

/// No triangle turns over, becomes a line, or comes to lie where there is one.
bool EdgeCollapse::keeps_sides(const Move& move) const {
  for (const std::uint32_t t : fan_[move.from]) {
    if (has(t, move.to)) continue;
    std::array<std::uint32_t, 3> corner = triangles_[t].corner;
    const Vec3d before = twice_area(corner);
    std::ranges::replace(corner, move.from, move.to);
    const Vec3d after = twice_area(corner);
    const double size = glm::length(after);
    if (!(size > kLeastTwiceArea)) return false;
    if (glm::dot(before, after) < kTurn * glm::length(before) * size) return false;
    for (const std::uint32_t other : fan_[move.to])
      if (std::ranges::all_of(corner, [&](std::uint32_t c) { return has(other, c); })) return false;
  }
  return true;
}

double EdgeCollapse::distance(const Vec3d& p, const std::array<std::uint32_t, 3>& corner) const {
  const Vec3d normal = twice_area(corner);
  const double size = glm::length(normal);
  bool inside = size > 0;
  double nearest = kInfinite;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = points_[corner[k]], &b = points_[corner[(k + 1) % 3]];
    inside = inside && glm::dot(glm::cross(normal, b - a), p - a) >= 0;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return inside ? std::abs(glm::dot(normal, p - points_[corner[0]])) / size : nearest;
}

/// Only points that stand for what lay on triangles that move can come to be farther off.
bool EdgeCollapse::keeps_near(const Move& move) const {
  std::vector<std::array<std::uint32_t, 3>> moved;
  for (const std::uint32_t t : fan_[move.from]) {
    if (has(t, move.to)) continue;
    moved.push_back(triangles_[t].corner);
    std::ranges::replace(moved.back(), move.from, move.to);
  }
  const auto near = [&](std::uint32_t original, std::uint32_t at) {
    const Vec3d& p = points_[original];
    return std::ranges::any_of(moved, [&](const auto& corner) { return distance(p, corner) <= error_; }) ||
           std::ranges::any_of(fan_[at], [&](std::uint32_t t) {
             return !has(t, move.from) && distance(p, triangles_[t].corner) <= error_;
           });
  };
  const auto all_near = [&](std::uint32_t point, std::uint32_t at) {
    return std::ranges::all_of(stands_for_[point], [&](std::uint32_t original) { return near(original, at); });
  };
  return all_near(move.from, move.to) &&
         std::ranges::all_of(neighbours(move.from), [&](std::uint32_t n) { return all_near(n, n); });
}

/// The course goes on from the other end of the edge before the point to where the point is moved to.
bool EdgeCollapse::keeps_course(const Move& move) const {
  const Points along = course(move.from);
  const std::uint32_t before = along[0] == move.to ? along[1] : along[0];
  const auto near = [&](const Vec3d& p, std::uint32_t a, std::uint32_t b) {
    return distance_to_segment(p, points_[a], points_[b]) <= error_;
  };
  const auto near_at = [&](const Vec3d& p, std::uint32_t end) {
    return std::ranges::any_of(course(end), [&](std::uint32_t c) { return c != move.from && near(p, end, c); });
  };
  for (const std::uint32_t point : {move.from, before, move.to})
    for (const std::uint32_t original : stands_for_[point]) {
      const Vec3d& p = points_[original];
      if (on_course_[original] && !near(p, before, move.to) && !near_at(p, before) && !near_at(p, move.to))
        return false;
    }
  return true;
}

void EdgeCollapse::apply(const Move& move) {
  for (const std::uint32_t t : fan_[move.from]) {
    if (has(t, move.to)) {
      triangles_[t].alive = false;
      for (const std::uint32_t c : triangles_[t].corner)
        if (c != move.from) std::erase(fan_[c], t);
      continue;
    }
    std::ranges::replace(triangles_[t].corner, move.from, move.to);
    fan_[move.to].push_back(t);
  }
  fan_[move.from].clear();
  std::ranges::copy(stands_for_[move.from], std::back_inserter(stands_for_[move.to]));
  stands_for_[move.from].clear();
  for (const std::uint32_t other : neighbours(move.to)) propose(move.to, other), propose(other, move.to);
}

}  // namespace manzana
