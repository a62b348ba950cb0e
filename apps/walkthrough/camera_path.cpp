#include "apps/walkthrough/camera_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace manzana::walkthrough {
namespace {

/// Slope at the middle of three points: the weighted harmonic mean of both secants, 0 at an extremum.
double slope_at(double h0, double h1, double secant0, double secant1) {
  if (!(secant0 * secant1 > 0)) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / secant0 + w1 / secant1);
}

/// The four keys about a time: [b, c] holds it, a and d are their neighbours (or themselves at the ends).
struct Span {
  const CameraKey *a, *b, *c, *d;
  double t;
};

double hermite(double s, double h, double y0, double y1, double m0, double m1) {
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * y0 + (s3 - 2 * s2 + s) * h * m0 + (3 * s2 - 2 * s3) * y1 + (s3 - s2) * h * m1;
}

template <class Get>
double coordinate(const Span& span, Get get) {
  const double h = span.c->t - span.b->t, y0 = get(*span.b), y1 = get(*span.c);
  const double secant = (y1 - y0) / h;
  double m0 = secant, m1 = secant;
  if (span.a != span.b) {
    const double before = span.b->t - span.a->t;
    m0 = slope_at(before, h, (y0 - get(*span.a)) / before, secant);
  }
  if (span.d != span.c) {
    const double after = span.d->t - span.c->t;
    m1 = slope_at(h, after, secant, (get(*span.d) - y1) / after);
  }
  const double y = hermite((span.t - span.b->t) / h, h, y0, y1, m0, m1);
  return std::clamp(y, std::min(y0, y1), std::max(y0, y1));  // only rounding is left to clamp
}

Vec3d point(const Span& span, Vec3d CameraPose::*member) {
  Vec3d p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = coordinate(span, [&](const CameraKey& key) { return (key.pose.*member)[axis]; });
  return p;
}

Span span_at(const std::vector<CameraKey>& keys, double t) {
  const auto after =
      std::upper_bound(keys.begin(), keys.end(), t, [](double v, const CameraKey& k) { return v < k.t; });
  const auto c = static_cast<std::size_t>(after - keys.begin()), b = c - 1;
  return {&keys[b > 0 ? b - 1 : b], &keys[b], &keys[c], &keys[std::min(c + 1, keys.size() - 1)], t};
}

}  // namespace

CameraPose pose_at(const CameraPath& path, double t) {
  assert(!path.keys.empty());
  if (!(t > path.keys.front().t)) return path.keys.front().pose;
  if (t >= path.keys.back().t) return path.keys.back().pose;
  const Span span = span_at(path.keys, t);
  CameraPose pose{point(span, &CameraPose::eye), point(span, &CameraPose::look)};
  // Where the look passes through the eye there is no direction: take the key's.
  if (glm::distance(pose.eye, pose.look) < 1e-6) pose.look = pose.eye + (span.b->pose.look - span.b->pose.eye);
  return pose;
}

Vec3d from_ground(const LocalFrame& frame, const Vec3d& p) {
  const Vec2d plan(p.x, p.y);
  return Vec3d(plan, frame.ground_z(plan)) + frame.up_at(plan) * p.z;
}

Vec3d to_ground(const LocalFrame& frame, const Vec3d& local) {
  Vec2d foot(local.x, local.y);
  double height = 0;
  for (int i = 0; i < 4; ++i) {  // up leans by 1.6e-7 a metre: each step is 1e-3 closer at 1000 m height and 1000 km
    const Vec3d up = frame.up_at(foot);
    height = (local.z - frame.ground_z(foot)) / up.z;
    foot = Vec2d(local.x, local.y) - Vec2d(up) * height;
  }
  return {foot, height};
}

culling::View view_of(const LocalFrame& frame, const CameraPose& pose, double aspect) {
  const Vec3d eye = from_ground(frame, pose.eye), look = from_ground(frame, pose.look);
  const Vec3d up = frame.up_at({pose.eye.x, pose.eye.y});
  return culling::look(eye, look - eye, up, glm::radians(kFovyDeg), aspect, kNear);
}

}  // namespace manzana::walkthrough
