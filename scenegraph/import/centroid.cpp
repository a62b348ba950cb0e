#include "scenegraph/import/centroid.h"

#include <algorithm>
#include <cmath>

namespace manzana {
namespace {

struct Moments {
  double area2 = 0;   // twice the signed area
  Vec2d first{0, 0};  // six times the first moment
};

Moments ring_moments(std::span<const Vec2d> ring, const Vec2d& origin) {
  Moments m;
  for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
    const Vec2d p = ring[i] - origin, q = ring[(i + 1) % n] - origin;
    const double cross = p.x * q.y - q.x * p.y;
    m.area2 += cross;
    m.first += (p + q) * cross;
  }
  return m;
}

// A hole counts against the outer ring whichever way it runs.
void subtract(Moments& outer, const Moments& hole) {
  const double sign = (outer.area2 < 0) == (hole.area2 < 0) ? -1.0 : 1.0;
  outer.area2 += sign * hole.area2;
  outer.first += sign * hole.first;
}

}  // namespace

void PlanBox::add(const Vec2d& p) {
  const bool first = empty();
  lo = first ? p : glm::min(lo, p);
  hi = first ? p : glm::max(hi, p);
}

PlanBox box_of(std::span<const Vec2d> points) {
  PlanBox box;
  for (const Vec2d& p : points) box.add(p);
  return box;
}

Centroid centroid(const Polygon& outline) {
  if (outline.outer.empty()) return {{0, 0}, 0, true};
  const PlanBox box = box_of(outline.outer);
  const Vec2d origin = outline.outer[0], diagonal = box.hi - box.lo;
  Moments sum = ring_moments(outline.outer, origin);
  for (const auto& hole : outline.holes) subtract(sum, ring_moments(hole, origin));
  const Vec2d center = origin + sum.first / (3.0 * sum.area2);
  const bool usable = std::abs(sum.area2) > 2e-12 * glm::dot(diagonal, diagonal) && box.contains(center);
  return {usable ? center : box.center(), usable ? 0.5 * std::abs(sum.area2) : 0, !usable};
}

}  // namespace manzana
