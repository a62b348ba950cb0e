#include "culling/host_camera.h"

#include <algorithm>
#include <cassert>
#include <cfloat>
#include <cmath>

namespace manzana::culling {
namespace {

constexpr double kUnit = DBL_EPSILON / 2;
/// A far plane whose normal is smaller than this part of the rows that it is the difference of is only their rounding.
constexpr double kNoise = 1e-12;

/// One row of a matrix: dot(normal, p) + offset.
struct Row {
  Vec3d normal;
  double offset;
};
Row row(const Mat4d& m, int i) { return {{m[0][i], m[1][i], m[2][i]}, m[3][i]}; }
Row operator+(const Row& a, const Row& b) { return {a.normal + b.normal, a.offset + b.offset}; }
Row operator-(const Row& a, const Row& b) { return {a.normal - b.normal, a.offset - b.offset}; }

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// a . b + c as if computed in twice the digits.  [Ogita, Rump, Oishi: Accurate Sum and Dot Product (2005), Dot2]
double dot_plus(const Vec3d& a, const Vec3d& b, double c) {
  double sum = c, lost = 0;
  for (int i = 0; i < 3; ++i) {
    const double product = a[i] * b[i];
    const double next = sum + product;
    const double back = next - sum;
    lost += (sum - (next - back)) + (product - back) + std::fma(a[i], b[i], -product);
    sum = next;
  }
  return sum + lost;
}

/// The eye, and where the view really puts it: not quite in the origin, because no double is the eye exactly.
struct Eye {
  Vec3d at, seen;
};
Eye find_eye(const Mat4d& view) {
  const Vec3d shift(view[3]);
  Vec3d at = -(glm::inverse(Mat3d(view)) * shift);
  if (!std::isfinite(at.x + at.y + at.z))
    at = Vec3d(0);  // a view without an inverse; the offsets then hold all of the shift
  Vec3d seen;
  for (int i = 0; i < 3; ++i) seen[i] = dot_plus(row(view, i).normal, at, shift[i]);
  return {at, seen};
}

/// From view space to L relative to the eye, and to length 1.
PlaneD turned(const Row& plane, const Mat4d& view, const Eye& eye) {
  Vec3d normal;
  for (int i = 0; i < 3; ++i) normal[i] = dot_plus(Vec3d(view[i]), plane.normal, 0);
  const double scale = largest(normal);
  if (!(scale > 0)) return kNoPlane;
  normal /= scale;  // before the length, whose square under- or overflows
  const double length = glm::length(normal);
  const double offset = dot_plus(plane.normal, eye.seen, plane.offset) / scale / length;
  normal /= length;
  const bool finite = largest(normal) <= 2 && std::abs(offset) <= static_cast<double>(FLT_MAX);
  return finite ? PlaneD{normal, offset} : kNoPlane;
}

/// The planes of depth as sums of the rows w and z. `range`: how many times larger than for a depth of 0..1.
struct Depth {
  Row near, far;
  double range;
};
Depth depth_planes(const Row& w, const Row& z, ClipDepth depth) {
  switch (depth) {
    case ClipDepth::minus_one_to_one:
      return {w + z, w - z, 2};
    case ClipDepth::zero_to_one:
      return {z, w - z, 1};
    case ClipDepth::reversed:
      return {w - z, z, 1};
  }
  assert(false);
  return {};
}

bool is_float(double v) {
  return std::abs(v) <= static_cast<double>(FLT_MAX) && static_cast<double>(static_cast<float>(v)) == v;
}
bool went_through_float(const Mat4d& m) {
  for (int column = 0; column < 4; ++column)
    for (int i = 0; i < 4; ++i)
      if (!is_float(m[column][i])) return false;
  return true;
}

/// The plane moved outward by what the host's own rounding may have taken from it: the entries of w and z are off by
/// units of their size, and nearly all of that size has cancelled in `far`. For a perspective this is 8 u f^2 / n.
Row padded(const Depth& planes, const Row& w, const Row& z) {
  const double size = largest(planes.far.normal);
  const double distance = std::abs(planes.far.offset) / size;
  const double lost =
      std::max(largest(w.normal), largest(z.normal)) * distance + std::abs(w.offset) + std::abs(z.offset);
  return {planes.far.normal, planes.far.offset + 8 * kUnit * planes.range * lost};
}

}  // namespace

HostFrustum make_frustum(const Mat4d& projection, const Mat4d& view, ClipDepth depth) {
  assert(row(view, 3).normal == Vec3d(0) && view[3][3] == 1);
  const Row x = row(projection, 0), y = row(projection, 1), z = row(projection, 2), w = row(projection, 3);
  const Depth depths = depth_planes(w, z, depth);
  const Eye eye = find_eye(view);
  HostFrustum host;
  FrustumD& f = host.frustum;
  f.eye = eye.at;
  f.planes = {turned(w + x, view, eye), turned(w - x, view, eye), turned(w + y, view, eye), turned(w - y, view, eye),
              turned(depths.near, view, eye)};
  f.count = 5;
  if (went_through_float(projection)) {
    host.far_plane = FarPlane::lost_in_float;
  } else if (largest(depths.far.normal) > kNoise * largest(w.normal)) {
    f.planes[kFar] = turned(padded(depths, w, z), view, eye);
    f.count = 6;
    host.far_plane = FarPlane::kept;
  }
  return host;
}

}  // namespace manzana::culling
