#include "foliage/line_rule.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace manzana::foliage {
namespace {

void check(bool sound, const char* what) {
  if (!sound) throw std::invalid_argument(std::string("line rule: ") + what);
}

bool is_measure(double v) { return v >= 0 && std::isfinite(v); }

/// Divided one by one: a product of four leaves the range of double sooner than the quotient.
double share_of_lines(const LineCloud& cloud, double distance_m, double spacing, double line) {
  return cloud.area_m2 / cloud.length_m / (2 * line) / distance_m / spacing;
}

}  // namespace

LineCounts line_counts(const LineCloud& cloud, double distance_m, double spacing, const LineRule& rule) {
  check(is_measure(cloud.area_m2) && is_measure(cloud.length_m) && is_measure(cloud.width_m), "a measure is no size");
  check(is_measure(spacing) && spacing > 0, "a spacing of nothing");
  check(is_measure(rule.line) && rule.line > 0, "lines without length");
  if (!(distance_m > 0) || cloud.lines == 0 || cloud.length_m == 0) return {};  // NaN too: all triangles
  if (std::isinf(distance_m)) return {1, 0};
  const double q = share_of_lines(cloud, distance_m, spacing, rule.line);
  const double width = cloud.width_m / distance_m / spacing;
  const double all = static_cast<double>(cloud.lines);
  if (!rule.gradual) return width <= 1 && q < 1 ? LineCounts{1, q * all} : LineCounts{};
  const double turned = std::clamp(std::min(2 - q, 2 - 2 * width), 0.0, 1.0);
  return {turned, turned * std::min(q, 1.0) * all};
}

LineCloud line_cloud(std::span<const LineSegment> lines) {
  LineCloud cloud;
  cloud.lines = lines.size();
  for (const LineSegment& line : lines) {
    const double length = glm::length(Vec3d(line.b) - Vec3d(line.a));
    const auto a = static_cast<double>(line.radius_a), b = static_cast<double>(line.radius_b);
    cloud.length_m += length;
    cloud.area_m2 += std::numbers::pi * length * (a + b);
    cloud.width_m = std::max(cloud.width_m, 2 * std::max(a, b));
  }
  return cloud;
}

}  // namespace manzana::foliage
