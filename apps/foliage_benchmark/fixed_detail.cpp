#include "apps/foliage_benchmark/fixed_detail.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage_benchmark {
namespace {

/// PreparedPlant::leaf_scale, linear between its steps.
float scale_at(const PreparedPlant& plant, double share) {
  const double at = std::clamp(-2 * std::log2(share), 0.0, 16.0);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), 15);
  return std::lerp(plant.leaf_scale[i], plant.leaf_scale[i + 1], static_cast<float>(at - static_cast<double>(i)));
}

}  // namespace

Detail all_detail(const PreparedPlant&) {
  Detail detail{};
  detail.share = detail.scale = 1;
  detail.lines = 1;
  return detail;
}

Detail pruned(const PreparedPlant& plant, double share) {
  Detail detail = all_detail(plant);
  detail.share = static_cast<float>(share);
  detail.scale = scale_at(plant, share);
  return detail;
}

Detail without_leaves(Detail detail) {
  detail.share = detail.to_points = detail.points = 0;
  return detail;
}

Detail without_branches(const PreparedPlant& plant, Detail detail) {
  detail.bark = static_cast<float>(plant.branch_levels.size());
  detail.lines = 0;
  return detail;
}

Detail at_branch_level(const PreparedPlant& plant, std::uint32_t level, bool with_lines) {
  Detail detail = all_detail(plant);
  detail.bark = static_cast<float>(level);
  if (!with_lines) detail.lines = 0;
  return detail;
}

Detail leaves_as_points(const PreparedPlant& plant, double area) {
  Detail detail = all_detail(plant);
  if (plant.point_levels.empty()) return detail;
  detail.to_points = 1;
  detail.points = static_cast<float>(plant.point_levels.front().points.size());
  detail.point_gain = static_cast<float>(area / static_cast<double>(detail.points));
  detail.fade = -1;  // as many as are meant
  return detail;
}

Detail unfaded(Detail detail) {
  detail.share *= 1 - std::max(0.0F, detail.fade) / 2;  // what shrinks away is worth half
  detail.fade = 0;
  detail.to_points = std::round(detail.to_points);
  detail.point_level = std::floor(detail.point_level);
  detail.line_level = std::floor(detail.line_level);
  detail.bark = std::floor(detail.bark);
  return detail;
}

}  // namespace manzana::foliage_benchmark
