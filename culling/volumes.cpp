#include "culling/volumes.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace manzana::culling {
namespace {

constexpr double kUnit = DBL_EPSILON / 2;
constexpr double kInf = std::numeric_limits<double>::infinity();

// std::hypot of three scales by the largest part, so that neither 1e-170 nor 1e200 loses its square.
double distance(const Vec3d& a, const Vec3d& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Larger than the exact value of any length computed here: the errors add up to 6.5 units (difference 1, quotient by
/// the largest part 1, hence 5 for the square, sums 2, halved by the root, root 1, product 1, adding the radius 1).
double outward(double length) { return length * (1 + 16 * kUnit) + DBL_MIN; }

float round_up(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}
float round_down(double v) { return -round_up(-v); }

/// The double just not above a - b. The rounding error of a difference is itself a double [Knuth, TAOCP 2, 4.2.2].
double difference_down(double a, double b) {
  const double d = a - b;
  const double back = d - a;
  const double error = (a - (d - back)) - (b + back);
  return error < 0 ? std::nextafter(d, -kInf) : d;
}

/// Bounds of a - b on one axis, in float.
float lower(double a, double b) { return round_down(difference_down(a, b)); }
float upper(double a, double b) { return round_up(-difference_down(b, a)); }

}  // namespace

BoxD merge(const BoxD& box, const Vec3d& point) { return {glm::min(box.min, point), glm::max(box.max, point)}; }

BoxD merge(const BoxD& a, const BoxD& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

Vec3d center(const BoxD& box) { return box.min / 2.0 + box.max / 2.0; }  // the sum of both could overflow

SphereD enclosing_sphere(std::span<const SphereD> spheres) {
  BoxD box;
  for (const SphereD& s : spheres)
    if (!s.empty()) box = merge(box, BoxD{s.center - s.radius, s.center + s.radius});
  if (box.empty()) return {};
  SphereD ball{center(box), 0};
  for (const SphereD& s : spheres)
    if (!s.empty()) ball.radius = std::max(ball.radius, distance(ball.center, s.center) + s.radius);
  ball.radius = outward(ball.radius);
  return ball;
}

SphereD enclosing_sphere(const BoxD& box) {
  if (box.empty()) return {};
  const Vec3d c = center(box);
  // The rounded centre may be nearer to either end of an axis.
  const Vec3d half = glm::max(box.max - c, c - box.min);
  return {c, outward(std::hypot(half.x, half.y, half.z))};
}

Sphere narrow(const SphereD& sphere, const Vec3d& origin) {
  if (sphere.empty()) return {};
  const Vec3d exact = sphere.center - origin;
  const Vec3 rounded(exact);
  const double moved = distance(Vec3d(rounded), exact);
  const double lost = kUnit * (std::abs(exact.x) + std::abs(exact.y) + std::abs(exact.z));  // by the difference
  return {rounded, round_up(outward(sphere.radius + moved + lost))};
}

Box narrow(const BoxD& box, const Vec3d& origin) {
  if (box.empty()) return {};
  return {{lower(box.min.x, origin.x), lower(box.min.y, origin.y), lower(box.min.z, origin.z)},
          {upper(box.max.x, origin.x), upper(box.max.y, origin.y), upper(box.max.z, origin.z)}};
}

}  // namespace manzana::culling
