#include "foliage/point_rule.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace manzana::foliage {

double points_wanted(double leaf_area_m2, double distance_m, double f_px, const PointRule& rule) {
  if (!(rule.spacing_px > 0) || !(rule.c_p > 0) || !(rule.near_m > 0) || !std::isfinite(rule.c_p))
    throw std::invalid_argument("a rule for points needs a spacing, a density and a nearest distance above 0");
  if (!std::isfinite(leaf_area_m2) || !std::isfinite(f_px) || std::isnan(distance_m))
    throw std::invalid_argument("leaf area, distance and focal length must be numbers");
  const double angle = f_px / (std::max(distance_m, rule.near_m) * rule.spacing_px);  // of a spacing, as seen
  return 0.5 * rule.c_p * leaf_area_m2 * angle * angle;
}

PointCounts point_counts(double p, std::uint64_t triangles, double threshold) {
  if (triangles == 0) return {};
  if (!(p < 3 * static_cast<double>(triangles))) return {triangles, 0};
  if (p < 1) return {0, threshold < p ? 1U : 0U};
  const auto vertices = static_cast<std::uint64_t>(p);
  if (vertices <= 2 * triangles) return {0, vertices};
  const std::uint64_t kept = vertices - 2 * triangles;
  return {kept, 2 * (triangles - kept)};
}

}  // namespace manzana::foliage
