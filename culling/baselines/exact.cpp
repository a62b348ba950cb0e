#include "culling/baselines/exact.h"

#include <algorithm>
#include <cassert>
#include <cfloat>
#include <cmath>

#include "culling/baselines/exact_planes.h"

namespace manzana::culling {

struct BigView {
  struct Axis {
    Big3 direction;
    Big low, high;
    bool has_low = true, has_high = true;
  };
  std::array<Big3, 8> corners;
  std::array<Big3, 4> rays;  ///< from the near corners along the edges
  bool infinite = false;
  std::vector<Axis> axes;
};

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
/// The slope between unit vectors that counts as none: a ray lies in its own face, and only rounding says otherwise.
const Big kFlat("1e-45"), kFlat2("1e-90");
/// Metres: what rounding may make of a touch.
const Big kTouch("1e-38");

Big3 meeting_point(const BigPlane& a, const BigPlane& b, const BigPlane& c) {
  const Big3 bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal), ab = cross(a.normal, b.normal);
  return (-1 / dot(a.normal, bc)) * (a.offset * bc + b.offset * ca + c.offset * ab);
}

/// The interval of the polyhedron along an axis.
BigView::Axis measure(const BigView& view, const Big3& direction) {
  BigView::Axis axis{direction, dot(direction, view.corners[0]), dot(direction, view.corners[0])};
  for (std::size_t i = 1; i < (view.infinite ? 4 : 8); ++i) {
    const Big at = dot(direction, view.corners[i]);
    axis.low = std::min(axis.low, at);
    axis.high = std::max(axis.high, at);
  }
  for (const Big3& ray : view.rays) {
    const Big slope = view.infinite ? dot(direction, ray) : Big(0);
    if (slope > kFlat) axis.has_high = false;
    if (slope < -kFlat) axis.has_low = false;
  }
  return axis;
}

/// Appended unless it is zero or parallel to one that is there.
void add_direction(std::vector<Big3>& all, const Big3& v) {
  if (dot(v, v) <= kFlat2) return;
  const Big3 direction = unit(v);
  const auto parallel = [&](const Big3& other) {
    const Big3 sine = cross(other, direction);
    return dot(sine, sine) <= kFlat2;
  };
  if (std::none_of(all.begin(), all.end(), parallel)) all.push_back(direction);
}

std::vector<Big3> edges(const BigPlanes& planes, bool infinite) {
  std::vector<Big3> all;
  const auto add = [&](PlaneIndex a, PlaneIndex b) { add_direction(all, cross(planes[a].normal, planes[b].normal)); };
  for (const PlaneIndex x : {kLeft, kRight})
    for (const PlaneIndex y : {kBottom, kTop}) add(x, y);
  for (const PlaneIndex side : {kLeft, kRight, kBottom, kTop}) {
    add(kNear, side);
    if (!infinite) add(kFar, side);
  }
  return all;
}

/// The plane at a corner: bit 0 of the index right, 1 top, 2 far.
const BigPlane& plane_at(const BigPlanes& planes, std::size_t corner, unsigned bit) {
  return planes[2 * bit + (corner >> bit & 1)];
}

void find_corners(BigView& view, const BigPlanes& planes) {
  for (std::size_t i = 0; i < (view.infinite ? 4 : 8); ++i)
    view.corners[i] = meeting_point(plane_at(planes, i, 0), plane_at(planes, i, 1), plane_at(planes, i, 2));
  for (std::size_t i = 0; i < 4; ++i) {
    Big3 along = unit(cross(plane_at(planes, i, 0).normal, plane_at(planes, i, 1).normal));
    if (dot(along, planes[kNear].normal) < 0) along = Big(-1) * along;
    view.rays[i] = along;
    if (view.infinite) view.corners[i + 4] = view.corners[i] + along;
  }
}

void find_axes(BigView& view, const BigPlanes& planes) {
  for (std::size_t k = 0; k < (view.infinite ? 5 : 6); ++k) view.axes.push_back(measure(view, planes[k].normal));
  const std::array box_axes{Big3{1, 0, 0}, Big3{0, 1, 0}, Big3{0, 0, 1}};
  std::vector<Big3> directions(box_axes.begin(), box_axes.end());
  for (const Big3& edge : edges(planes, view.infinite))
    for (const Big3& axis : box_axes)
      if (const Big3 v = cross(axis, edge); dot(v, v) > kFlat2) directions.push_back(unit(v));
  for (const Big3& direction : directions) view.axes.push_back(measure(view, direction));
}

ExactView rounded(const Vec3d& eye, const BigPlanes& planes, std::shared_ptr<const BigView> exact) {
  ExactView view{eye, {}, {}, {}, exact};
  for (std::size_t k = 0; k < (exact->infinite ? 5 : 6); ++k)
    view.planes.push_back({to_double(planes[k].normal), static_cast<double>(planes[k].offset)});
  std::transform(exact->corners.begin(), exact->corners.end(), view.corners.begin(), to_double);
  for (const BigView::Axis& axis : exact->axes)
    view.axes.push_back({to_double(axis.direction), axis.has_low ? static_cast<double>(axis.low) : -kInf,
                         axis.has_high ? static_cast<double>(axis.high) : kInf});
  return view;
}

ExactView make_exact(const Vec3d& eye, const BigPlanes& planes) {
  assert(std::none_of(planes.begin(), planes.begin() + 5, missing));
  auto exact = std::make_shared<BigView>();
  exact->infinite = missing(planes[kFar]);
  find_corners(*exact, planes);
  find_axes(*exact, planes);
  return rounded(eye, planes, std::move(exact));
}

/// Direction, operands relative to the eye, products, three sums: each rounds once; the interval's end too.
constexpr double kMargin64 = 8 * DBL_EPSILON / 2;

double end_margin(double end) { return std::isfinite(end) ? kMargin64 * std::abs(end) : 0; }

/// How far the box low..high, relative to the eye, reaches into the interval of an axis from either end, metres, and
/// what double may have lost of that.
struct Reach {
  double above, below, margin;
};
Reach reach(const ExactView::Axis& axis, const Vec3d& low, const Vec3d& high) {
  const Vec3d a = axis.direction * low, b = axis.direction * high;
  const Vec3d least = glm::min(a, b), most = glm::max(a, b), size = glm::max(glm::abs(a), glm::abs(b));
  return {most.x + most.y + most.z - axis.low, axis.high - (least.x + least.y + least.z),
          kMargin64 * (size.x + size.y + size.z)};
}

enum class Apart : std::uint8_t { no, yes, unsure };

/// Only what double is certain of.
Apart apart(const ExactView::Axis& axis, const Vec3d& low, const Vec3d& high) {
  const Reach at = reach(axis, low, high);
  const double margin_low = at.margin + end_margin(axis.low), margin_high = at.margin + end_margin(axis.high);
  if (at.above < -margin_low || at.below < -margin_high) return Apart::yes;
  return at.above > margin_low && at.below > margin_high ? Apart::no : Apart::unsure;
}

/// Certainly inside all planes.
bool holds(const ExactView& view, const Vec3d& p) {
  return std::all_of(view.planes.begin(), view.planes.end(), [&](const PlaneD& plane) {
    const Vec3d t = plane.normal * p, size = glm::abs(t);
    const double margin = kMargin64 * (size.x + size.y + size.z + std::abs(plane.offset));
    return t.x + t.y + t.z + plane.offset > margin;
  });
}

bool exactly_apart(const BigView::Axis& axis, const Big3& low, const Big3& high) {
  Big least = 0, most = 0;
  for (const auto& part : {&Big3::x, &Big3::y, &Big3::z}) {
    const Big a = axis.direction.*part * (low.*part), b = axis.direction.*part * (high.*part);
    least += std::min(a, b);
    most += std::max(a, b);
  }
  return (axis.has_low && most < axis.low - kTouch) || (axis.has_high && least > axis.high + kTouch);
}

}  // namespace

ExactView make_exact(const View& view) { return make_exact(view.eye, exact_planes(view)); }

ExactView make_exact(const Mat4d& projection, const Mat4d& view, ClipDepth depth) {
  const Vec3d eye = -(glm::inverse(Mat3d(view)) * Vec3d(view[3]));
  return make_exact(eye, exact_planes(projection, view, depth, eye));
}

bool exactly_overlaps(const ExactView& view, const BoxD& box) {
  if (box.empty()) return false;
  const Vec3d low = box.min - view.eye, high = box.max - view.eye;
  if (holds(view, low / 2.0 + high / 2.0)) return true;
  std::uint64_t unsure = 0;
  for (std::size_t i = 0; i < view.axes.size(); ++i) {
    const Apart answer = apart(view.axes[i], low, high);
    if (answer == Apart::yes) return false;
    if (answer == Apart::unsure) unsure |= std::uint64_t{1} << i;
  }
  if (unsure == 0) return true;
  const Big3 exact_low = big(box.min) - big(view.eye), exact_high = big(box.max) - big(view.eye);
  for (std::size_t i = 0; i < view.axes.size(); ++i)
    if ((unsure >> i & 1) != 0 && exactly_apart(view.exact->axes[i], exact_low, exact_high)) return false;
  return true;
}

double reach_into(const ExactView& view, const BoxD& box) {
  if (!exactly_overlaps(view, box)) return 0;
  const Vec3d low = box.min - view.eye, high = box.max - view.eye;
  double least = kInf;
  for (const ExactView::Axis& axis : view.axes) {
    const Reach at = reach(axis, low, high);
    least = std::min({least, at.above, at.below});
  }
  return std::max(least, 0.0);
}

std::vector<bool> exactly_visible(const View& view, std::span<const BoxD> boxes) {
  const ExactView exact = make_exact(view);
  std::vector<bool> seen;
  seen.reserve(boxes.size());
  for (const BoxD& box : boxes) seen.push_back(exactly_overlaps(exact, box));
  return seen;
}

}  // namespace manzana::culling
