#include <algorithm>
#include <cmath>

#include "foliage/laws.h"
#include "foliage/leaf_scale.h"
#include "foliage/line_rule.h"
#include "foliage/point_rule.h"

namespace manzana::foliage {
namespace {

/// Of p points, in the finest level's order, c_p times half the leaves' area.
void set_points(Detail& d, const PreparedPlant& plant, double p, double c_p) {
  const PointLevel& finest = plant.point_levels.front();
  d.points = static_cast<float>(std::min(p, static_cast<double>(finest.points.size())));
  const double half_area = static_cast<double>(plant.leaf_area_m2) / 2;
  d.point_gain = static_cast<float>(c_p * half_area / static_cast<double>(finest.area) / std::max(1.0, p));
}

void set_leaf_points(Detail& d, const PreparedPlant& plant, double error_m) {
  if (plant.point_levels.empty()) return;
  const PointRule rule{.spacing_px = 1, .near_m = 1e-9};
  const auto k = static_cast<double>(2 * plant.leaves.size());
  const double p = points_wanted(static_cast<double>(plant.leaf_area_m2), error_m, 1, rule);
  // p - 2k of k triangles, and two points for each of the others.
  d.to_points = static_cast<float>(std::clamp((3 * k - p) / k, 0.0, 1.0));
  d.fade = -1;
  set_points(d, plant, std::min(p, 2 * k), rule.c_p);
}

/// The lines that the next level adds, as one kind of thing each; the finest sets turn first.
void set_branch_lines(Detail& d, const PreparedPlant& plant, double error_m) {
  double bark = 0, drawn = 0, turned = 0;
  const std::vector<BranchLevel>& levels = plant.branch_levels;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const std::uint32_t first = l + 1 < levels.size() ? levels[l + 1].first_line : 0;
    const LineCloud cloud = line_cloud(std::span(plant.lines).subspan(first, levels[l].first_line - first));
    const LineCounts counts = line_counts(cloud, error_m, 1, {});
    if (counts.turned <= 0) break;
    bark += counts.turned;
    drawn += counts.drawn;
    turned += counts.turned * static_cast<double>(cloud.lines);
    if (counts.turned < 1) break;
  }
  d.bark = static_cast<float>(bark);
  d.lines = static_cast<float>(turned > 0 ? drawn / turned : 1);
}

}  // namespace

Detail show_pruned(const PreparedPlant& plant, double u) {
  Detail d = show_all();
  set_leaves(d, u, static_cast<double>(leaf_scale_at(plant.leaf_scale, static_cast<float>(u))));
  d.hidden = 1;
  return d;
}

Detail show_points_and_lines(const PreparedPlant& plant, double error_m) {
  Detail d = show_all();
  set_leaf_points(d, plant, error_m);
  set_branch_lines(d, plant, error_m);
  return d;
}

Detail show_levels(const PreparedPlant& plant, const LawMeasures& m, double error_m) {
  Detail d = show_all();
  std::size_t level = 0;
  while (level + 1 < m.widths_m.size() && m.widths_m[level + 1] <= error_m) ++level;
  d.bark = static_cast<float>(level);
  if (plant.point_levels.empty() || m.quad_m > error_m) return d;
  d.to_points = 1;
  d.fade = -1;
  set_points(d, plant, static_cast<double>(plant.point_levels.front().points.size()), 1);
  return d;
}

}  // namespace manzana::foliage
