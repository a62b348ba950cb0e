#include "scenegraph/local_frame.h"

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace manzana {
namespace {

using GeographicLib::Geocentric;

constexpr double kMaxLongitude = 540;

Vec3d to_earth_centred(const GeoPoint& p) {
  Vec3d e;
  Geocentric::WGS84().Forward(p.lat_deg, p.lon_deg, p.height_m, e.x, e.y, e.z);
  return e;
}

// Earth-centred metres to a space in which the ellipsoid is the unit sphere.
Vec3d to_unit_sphere(const Vec3d& e) {
  const double a = Geocentric::WGS84().EquatorialRadius();
  const double b = a * (1 - Geocentric::WGS84().Flattening());
  return {e.x / a, e.y / a, e.z / b};
}

/// The point of the ellipsoid below an earth-centred position.
GeoPoint below(const Vec3d& e) {
  GeoPoint point;
  Geocentric::WGS84().Reverse(e.x, e.y, e.z, point.lat_deg, point.lon_deg, point.height_m);
  point.height_m = 0;
  return point;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

bool valid(const GeoPoint& p) {
  return std::isfinite(p.height_m) && std::abs(p.lat_deg) <= 90 && std::abs(p.lon_deg) <= kMaxLongitude;
}

GeoPoint center_of(std::span<const GeoPoint> points) {
  Vec3d sum{0, 0, 0};
  std::size_t n = 0;
  for (const GeoPoint& p : points) {
    if (!valid(p)) continue;
    sum += to_earth_centred(p);
    ++n;
  }
  if (n == 0) return {};
  return below(sum / static_cast<double>(n));
}

GeoPoint median_of(std::span<const GeoPoint> points) {
  std::array<std::vector<double>, 3> values;
  for (const GeoPoint& p : points) {
    if (!valid(p)) continue;
    const Vec3d e = to_earth_centred(p);
    for (int k = 0; k < 3; ++k) values[static_cast<std::size_t>(k)].push_back(e[k]);
  }
  if (values[0].empty()) return {};
  return below({median(values[0]), median(values[1]), median(values[2])});
}

LocalFrame::LocalFrame(const GeoPoint& anchor) : anchor_(anchor) {
  if (!valid(anchor))
    throw std::invalid_argument("a local frame needs a finite anchor with a latitude within [-90, 90]");
  projection_.Reset(anchor.lat_deg, anchor.lon_deg, anchor.height_m);
  Vec3d e;
  std::vector<double> m(9);  // row-major; its columns are east, north and up in earth-centred axes
  Geocentric::WGS84().Forward(anchor.lat_deg, anchor.lon_deg, anchor.height_m, e.x, e.y, e.z, m);
  position_ = to_unit_sphere(e);
  for (int column = 0; column < 3; ++column) {
    const auto c = static_cast<std::size_t>(column);
    axes_[column] = to_unit_sphere({m[c], m[c + 3], m[c + 6]});
  }
}

Vec3d LocalFrame::to_local(const GeoPoint& point) const {
  assert(valid(point));
  Vec3d p;
  projection_.Forward(point.lat_deg, point.lon_deg, point.height_m, p.x, p.y, p.z);
  return p;
}

GeoPoint LocalFrame::to_geo(const Vec3d& local) const {
  GeoPoint p;
  projection_.Reverse(local.x, local.y, local.z, p.lat_deg, p.lon_deg, p.height_m);
  return p;
}

// |position + x east + y north + z up| = 1 in the unit sphere's space is A z^2 + 2 B z + C = 0; of its two roots the
// one on the anchor's side of the Earth, in the form that does not cancel.
double LocalFrame::ground_z(const Vec2d& plan) const {
  const Vec3d foot = position_ + plan.x * axes_[0] + plan.y * axes_[1];
  const double A = glm::dot(axes_[2], axes_[2]);
  const double B = glm::dot(foot, axes_[2]);
  const double C = glm::dot(foot, foot) - 1;
  return -C / (B + std::sqrt(std::max(B * B - A * C, 0.0)));
}

// The gradient of |p|^2 with respect to (x, y, z): each axis' share of the ellipsoid's normal.
Vec3d LocalFrame::up_at(const Vec2d& plan) const {
  const Vec3d p = position_ + plan.x * axes_[0] + plan.y * axes_[1] + ground_z(plan) * axes_[2];
  return glm::normalize(Vec3d(glm::dot(p, axes_[0]), glm::dot(p, axes_[1]), glm::dot(p, axes_[2])));
}

BlockFrame block_frame(const LocalFrame& frame, const Vec2d& plan_center) {
  const Vec3d up = frame.up_at(plan_center);
  // The gradient is always nearer to z than to x (up_at never leaves the anchor's half of the Earth), so this never
  // vanishes.
  const Vec3d y = glm::normalize(glm::cross(up, Vec3d(1, 0, 0)));
  return {{plan_center.x, plan_center.y, frame.ground_z(plan_center)}, Mat3d(glm::cross(y, up), y, up)};
}

}  // namespace manzana
