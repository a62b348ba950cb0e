#include "culling/baselines/touching.h"

#include <algorithm>
#include <cmath>

namespace manzana::baselines {
namespace {

using culling::BoxD;
using culling::ExactView;
using culling::PlaneD;

/// A point of the body by its place between left and right, bottom and top, near and far, each 0 to 1. Interpolated
/// along edges, so that 0 and 1 stay in their faces.
Vec3d point_at(const ExactView& body, double x, double y, double along) {
  const auto edge = [&](std::size_t i) {
    const Vec3d &from = body.corners[i], &to = body.corners[i + 4];
    return from + along * (to - from);
  };
  return glm::mix(glm::mix(edge(0), edge(1), x), glm::mix(edge(2), edge(3), x), y);
}

/// A place on the edges from near to far, in units of their length (of 1 m, where there is no far plane).
double along_edges(const ExactView& body, double metres) {
  return body.infinite() ? metres : std::min(1.0, metres / glm::distance(body.corners[0], body.corners[4]));
}

}  // namespace

double random_distance(Random& random, double reach) {
  return random.chance(0.5) ? random.in(0, reach) : random.scale(1e-3, reach);
}

Touch touch(const ExactView& body, Random& random, int planes, double reach) {
  std::array<double, 3> at{random.unit(), random.unit(), along_edges(body, random_distance(random, reach))};
  // Of the three pairs of opposite planes, `planes` are chosen, and of each pair one.
  const std::size_t start = random.below(3);
  Vec3d away(0);
  for (std::size_t k = start; k < start + static_cast<std::size_t>(planes); ++k) {
    const std::size_t pair = k % 3;
    const std::size_t side = pair == 2 && body.infinite() ? 0 : random.below(2);
    at[pair] = static_cast<double>(side);
    away -= random.in(0.001, 1) * body.planes[2 * pair + side].normal;
  }
  return {point_at(body, at[0], at[1], at[2]), glm::normalize(away)};
}

Vec3d point_inside(const ExactView& body, Random& random, double metres) {
  const double x = random.unit(), y = random.unit();
  return point_at(body, x, y, along_edges(body, metres));
}

BoxD box_on(const ExactView& body, const Touch& touch, const Vec3d& size, double depth) {
  const Vec3d corner = body.eye + (touch.point - depth * touch.away);
  return merge(BoxD{corner, corner}, corner + glm::sign(touch.away) * size);
}

BoxD box_along_axis(const ExactView& body, Random& random, const Vec3d& size, double depth, double reach) {
  constexpr double kNone = 1e-12;
  const ExactView::Axis& axis = body.axes[random.below(body.axes.size())];
  const bool up = std::isinf(axis.low) || (std::isfinite(axis.high) && random.chance(0.5));
  const Vec3d away = up ? axis.direction : -axis.direction;
  const double end = up ? axis.high : -axis.low;
  // The body's feature there: one corner, or the way between two.
  std::vector<Vec3d> support;
  for (std::size_t i = 0; i < 8; ++i)
    if (glm::dot(away, body.corners[i]) >= end - kNone * (1 + std::abs(end))) support.push_back(body.corners[i]);
  if (support.empty()) support.push_back(body.corners[0]);
  const Vec3d &a = support[random.below(support.size())], &b = support[random.below(support.size())];
  const double way = glm::distance(a, b);
  const double along = way > 0 ? random.unit() * std::min(1.0, reach / way) : 0;
  Vec3d middle = a + along * (b - a) - depth * away;
  for (int i = 0; i < 3; ++i)
    middle[i] += std::abs(away[i]) < kNone ? random.in(-0.5, 0.5) * size[i] : std::copysign(size[i] / 2, away[i]);
  return {body.eye + (middle - size / 2.0), body.eye + (middle + size / 2.0)};
}

}  // namespace manzana::baselines
