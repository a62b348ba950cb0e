#include "culling/baselines/exact.h"

#include <algorithm>
#include <cmath>

namespace manzana::culling {
namespace {

constexpr long double kInf = std::numeric_limits<long double>::infinity();
/// The slope between unit vectors that counts as none: a ray lies in its own face, and only rounding says otherwise.
constexpr long double kFlat = 8 * std::numeric_limits<long double>::epsilon();

/// The interval of the polyhedron along an axis.
ExactView::Axis measure(const ExactView& view, const Vec3l& direction) {
  ExactView::Axis axis{direction, kInf, -kInf};
  for (const Vec3l& corner : view.corners) {
    const long double at = glm::dot(direction, corner);
    axis.low = std::min(axis.low, at);
    axis.high = std::max(axis.high, at);
  }
  for (const Vec3l& ray : view.rays) {
    const long double slope = glm::dot(direction, ray);
    if (slope > kFlat) axis.high = kInf;
    if (slope < -kFlat) axis.low = -kInf;
  }
  return axis;
}

bool separates(const ExactView::Axis& axis, const Vec3l& low, const Vec3l& high) {
  const Vec3l a = axis.direction * low;
  const Vec3l b = axis.direction * high;
  const Vec3l least = glm::min(a, b);
  const Vec3l most = glm::max(a, b);
  return most.x + most.y + most.z < axis.low || least.x + least.y + least.z > axis.high;
}

long double tangent(double t) { return static_cast<long double>(t); }

/// The camera's axes, orthonormal to the last place of long double.
std::array<Vec3l, 3> basis(const View& view) {
  const Vec3l forward = glm::normalize(Vec3l(view.forward));
  Vec3l right(view.right);
  right = glm::normalize(right - glm::dot(right, forward) * forward);
  Vec3l up(view.up);
  up -= glm::dot(up, forward) * forward;
  return {right, glm::normalize(up - glm::dot(up, right) * right), forward};
}

void add_axis(ExactView& view, const Vec3l& direction) {
  if (glm::length(direction) > 0) view.axes.push_back(measure(view, glm::normalize(direction)));
}

}  // namespace

ExactView make_exact(const View& view) {
  const auto [right, up, forward] = basis(view);
  std::vector<Vec3l> sides;  // the four edges from the eye, in turn round it
  for (const auto& [x, y] : {std::pair{view.tan_left, view.tan_bottom}, std::pair{view.tan_right, view.tan_bottom},
                             std::pair{view.tan_right, view.tan_top}, std::pair{view.tan_left, view.tan_top}})
    sides.push_back(forward + tangent(x) * right + tangent(y) * up);

  ExactView exact{Vec3l(view.eye), {}, {}, {}};
  const bool infinite = !std::isfinite(view.far_m);
  for (const Vec3l& side : sides) {
    exact.corners.push_back(side * static_cast<long double>(view.near_m));
    if (infinite) exact.rays.push_back(glm::normalize(side));
    if (!infinite) exact.corners.push_back(side * static_cast<long double>(view.far_m));
  }

  add_axis(exact, forward);
  add_axis(exact, right - tangent(view.tan_left) * forward);
  add_axis(exact, right - tangent(view.tan_right) * forward);
  add_axis(exact, up - tangent(view.tan_bottom) * forward);
  add_axis(exact, up - tangent(view.tan_top) * forward);
  const std::array<Vec3l, 3> box_axes{Vec3l(1, 0, 0), Vec3l(0, 1, 0), Vec3l(0, 0, 1)};
  sides.push_back(right);
  sides.push_back(up);
  for (const Vec3l& axis : box_axes) add_axis(exact, axis);
  for (const Vec3l& axis : box_axes)
    for (const Vec3l& edge : sides) add_axis(exact, glm::cross(axis, edge));
  return exact;
}

bool exactly_overlaps(const ExactView& view, const BoxD& box) {
  if (box.empty()) return false;
  const Vec3l low = Vec3l(box.min) - view.eye;
  const Vec3l high = Vec3l(box.max) - view.eye;
  return std::none_of(view.axes.begin(), view.axes.end(),
                      [&](const ExactView::Axis& axis) { return separates(axis, low, high); });
}

std::vector<bool> exactly_visible(const View& view, std::span<const BoxD> boxes) {
  const ExactView exact = make_exact(view);
  std::vector<bool> seen;
  seen.reserve(boxes.size());
  for (const BoxD& box : boxes) seen.push_back(exactly_overlaps(exact, box));
  return seen;
}

}  // namespace manzana::culling
