#include "scenegraph/import/plan_geometry.h"

#include <algorithm>
#include <cmath>

namespace manzana::plan {

bool finite(std::span<const Vec2d> points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Vec2d& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

double area(std::span<const Vec2d> ring) {
  double twice = 0;
  for (std::size_t i = 2; i < ring.size(); ++i) twice += turn(ring[0], ring[i - 1], ring[i]);
  return twice / 2;
}

double area(const Polygon& shape) {
  double sum = std::abs(area(shape.outer));
  for (const Ring& hole : shape.holes) sum -= std::abs(area(hole));
  return std::max(sum, 0.0);
}

Vec2d centroid(std::span<const Vec2d> ring) {
  Vec2d sum{0, 0};
  double twice = 0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    const double weight = turn(ring[0], ring[i - 1], ring[i]);
    sum += weight * (ring[i - 1] + ring[i] - 2.0 * ring[0]) / 3.0;
    twice += weight;
  }
  return twice == 0 ? ring[0] : ring[0] + sum / twice;
}

bool strictly_convex(std::span<const Vec2d> ring) {
  const std::size_t n = ring.size();
  double angle = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2d in = ring[(i + 1) % n] - ring[i], out = ring[(i + 2) % n] - ring[(i + 1) % n];
    const double left = cross(in, out);
    if (!(left > 1e-6 * glm::length(in) * glm::length(out))) return false;
    angle += std::atan2(left, glm::dot(in, out));
  }
  return n >= 3 && angle < 7;  // once round is 6.28, twice 12.6
}

bool star_shaped_from(std::span<const Vec2d> ring, const Vec2d& eye) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (turn(eye, a, b) < 0.05 * glm::length(b - a)) return false;  // nearer than 5 cm to a wall's line is a sliver
  }
  return ring.size() >= 3;
}

Ring convex_hull(Ring points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2d& a, const Vec2d& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  Ring hull;
  const auto chain = [&hull](auto first, auto last) {
    const std::size_t base = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), *first) <= 0) hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // it opens the other chain
  };
  if (points.size() < 3) return points;
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

namespace {

OrientedBox box_along(std::span<const Vec2d> hull, const Vec2d& along) {
  const Vec2d across = left_of(along);
  Vec2d low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Vec2d& p : hull) {
    const Vec2d q{glm::dot(p, along), glm::dot(p, across)};
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  const Vec2d middle = (low + high) / 2.0, half = (high - low) / 2.0;
  OrientedBox box{along * middle.x + across * middle.y, along, half.x, half.y};
  if (half.x < half.y) box = {box.center, across, half.y, half.x};
  return box;
}

}  // namespace

OrientedBox smallest_rectangle(std::span<const Vec2d> ring) {
  const Ring hull = convex_hull(Ring(ring.begin(), ring.end()));
  OrientedBox best;
  double best_area = 1e300, best_side = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2d edge = hull[(i + 1) % hull.size()] - hull[i];
    const double side = glm::length(edge);
    if (!(side > 0)) continue;
    const OrientedBox box = box_along(hull, edge / side);
    const double size = box.half_length * box.half_width;
    const bool tie = std::abs(size - best_area) < 0.01 * best_area;  // then the longer wall gives the direction
    if (tie ? side <= best_side : size > best_area) continue;
    best = box;
    best_area = size;
    best_side = side;
  }
  return best;
}

Ring simplified(std::span<const Vec2d> ring) {
  Ring kept;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2d& before = kept.empty() ? ring[n - 1] : kept.back();
    const Vec2d in = ring[i] - before, out = ring[(i + 1) % n] - ring[i];
    const double a = glm::length(in), b = glm::length(out), bend = std::abs(cross(in, out));
    const bool repeats = a < 1e-3 && !kept.empty();
    const bool straight = glm::dot(in, out) > 0 && bend < 0.02 * a * b && bend < 0.01 * (a + b);
    if (!repeats && !straight) kept.push_back(ring[i]);
  }
  while (kept.size() > 1 && glm::length(kept.front() - kept.back()) < 1e-3) kept.pop_back();
  return kept;
}

void wind(Polygon& shape) {
  if (area(shape.outer) < 0) std::reverse(shape.outer.begin(), shape.outer.end());
  for (Ring& hole : shape.holes)
    if (area(hole) > 0) std::reverse(hole.begin(), hole.end());
}

namespace {

std::vector<Triangle> fan(const Ring& ring) {
  std::vector<Triangle> result;
  for (std::size_t i = 2; i < ring.size(); ++i) result.push_back({ring[0], ring[i - 1], ring[i]});
  return result;
}

std::optional<Triangle> triangle(const Geos& geos, const GEOSGeometry* g) {
  const std::vector<Vec2d> p = geos.points(GEOSGetExteriorRing_r(geos.handle(), g));
  if (p.size() != 3) return {};
  const double twice = turn(p[0], p[1], p[2]);
  if (twice == 0) return {};
  return twice > 0 ? Triangle{p[0], p[1], p[2]} : Triangle{p[0], p[2], p[1]};
}

}  // namespace

std::vector<Triangle> triangulate(const Geos& geos, const Polygon& shape) {
  if (shape.holes.empty() && strictly_convex(shape.outer)) return fan(shape.outer);
  const Geometry polygon = geos.polygon(shape);
  if (!polygon) return {};
  const Geometry cut = geos.owned(GEOSConstrainedDelaunayTriangulation_r(geos.handle(), polygon.get()));
  std::vector<Triangle> result;
  const int count = cut ? GEOSGetNumGeometries_r(geos.handle(), cut.get()) : 0;
  for (int i = 0; i < count; ++i)
    if (const auto t = triangle(geos, GEOSGetGeometryN_r(geos.handle(), cut.get(), i))) result.push_back(*t);
  return result;
}

}  // namespace manzana::plan
