#include <algorithm>
#include <cmath>

#include "foliage/laws.h"

namespace manzana::foliage {
namespace {

// Measured against all detail, crowns 12 to 512 px high, all plants of data/trees: docs/measurements.md.
constexpr double kPointsAPixel = 2.6;                      // that the plant covers
constexpr double kQuads = 3, kPointsOnly = 1.5;            // sides of a leaf quad, over the error
constexpr double kFewPoints = 1.0 / 3, kManyPoints = 0.5;  // over leaf quads: beyond this many points save nothing
constexpr double kLeastQuad = 0.75;                        // over the error
constexpr double kThickest = 2.1, kThinnest = 1.25;        // over the error: where a mesh turns into lines

/// The share at which leaves scaled by s cover what all of them did: leaf_scale read backwards, linear in log u.
double share_for_scale(const std::array<float, 17>& scale, double s) {
  if (s <= 1) return 1;
  for (std::size_t i = 0; i + 1 < scale.size(); ++i) {
    const auto a = static_cast<double>(scale[i]), b = static_cast<double>(scale[i + 1]);
    if (s < b) return std::exp2(-0.5 * (static_cast<double>(i) + (b > a ? std::max(0.0, s - a) / (b - a) : 0)));
  }
  return std::exp2(-8);
}

/// Factors at a quarter, half and three quarters of the way, 1 at its ends.
double on_the_way(const std::array<float, 3>& quarters, double x) {
  const std::array<float, 5> at{1, quarters[0], quarters[1], quarters[2], 1};
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(4 * x), 3);
  return std::lerp(static_cast<double>(at[i]), static_cast<double>(at[i + 1]), 4 * x - static_cast<double>(i));
}

/// How many points of the mean area those are worth that select.glsl's faded() shows where so many are meant, on
/// average over trees: a point of rank r that is shown counts min((edge - r) / fade, 1), the edge being `meant`, its
/// fade, and a random part of 1. Point by point, since the first few are not like the mean.
double worth(const PreparedPlant& plant, const PointLevel& level, double meant) {
  const auto share = static_cast<double>(glsl::kPointFade), n = static_cast<double>(level.points.size());
  const double edge = (1 + share) * meant, fade = std::max(share * n, 1.0);
  if (edge >= n + fade || !(level.area > 0)) return n;
  const auto up_to = [&](double t) { return t < fade ? t * t / (2 * fade) : t - fade / 2; };
  double area = 0;
  for (std::uint32_t r = 0; r < level.points.size() && r < edge; ++r)
    area += static_cast<double>(plant.points[level.points.first + r].area) *
            (up_to(edge + 1 - r) - up_to(std::max(1.0, edge - r)));
  return area * n / static_cast<double>(level.area);
}

/// So many points for each square of the error that the plant covers, of two levels: so far from the finer one to the
/// coarser that together they are as many.  [after Deussen 2005, equation 10.5]
void set_points(Detail& d, const PreparedPlant& plant, double error_m) {
  const std::vector<PointLevel>& levels = plant.point_levels;
  if (levels.empty()) return;
  const auto size = [&](std::size_t level) { return static_cast<double>(levels[level].points.size()); };
  const double wanted = kPointsAPixel * static_cast<double>(plant.cover_m2) / (error_m * error_m);
  const double p = std::clamp(wanted, 1e-3, size(0));
  std::size_t level = 0;
  while (level + 1 < levels.size() && p <= size(level + 1)) ++level;
  const bool last = level + 1 == levels.size();
  const double x = last ? 0 : std::clamp((size(level) - p) / (size(level) - size(level + 1)), 0.0, 1.0);
  d.points = static_cast<float>(p);
  d.point_level = static_cast<float>(static_cast<double>(level) + x);
  const double m = last ? 0 : x * size(level + 1),
               shown = worth(plant, levels[level], p - m) + (last ? 0 : worth(plant, levels[level + 1], m));
  d.point_gain = static_cast<float>(on_the_way(levels[level].between, x) / shown);
}

/// By the size of leaves; never where there would be about as many points as there are quads.
double share_of_points(const PreparedPlant& plant, const Detail& d, double quad_px) {
  if (plant.point_levels.empty() || quad_px <= 0) return 0;
  const double many = static_cast<double>(d.points) / static_cast<double>(plant.leaves.size());
  return std::clamp((kQuads - quad_px) / (kQuads - kPointsOnly), 0.0, 1.0) *
         std::clamp((kManyPoints - many) / (kManyPoints - kFewPoints), 0.0, 1.0);
}

/// Leaves likewise, where they are thin.
double share_of_lines(const LawMeasures& m, double error_m) {
  if (m.thin.width_m <= 0) return 0;
  return std::clamp((kThickest - m.thin.width_m / error_m) / (kThickest - kThinnest), 0.0, 1.0);
}

/// Meshes give way to lines where those are thin, one branch after the other.
double mesh_level(const LawMeasures& m, double error_m) {
  double level = 0;
  for (std::size_t next = 1; next < m.widths_m.size(); ++next) {
    const double t = (kThickest - m.widths_m[next] / error_m) / (kThickest - kThinnest);
    level = std::max(level, static_cast<double>(next - 1) + std::clamp(t, 0.0, 1.0));
    if (t < 1) break;
  }
  return level;
}

/// None where even the trunk is not seen, an eighth of the error and less: but of a plant without leaves, which is
/// nothing else.
void set_lines(Detail& d, const PreparedPlant& plant, double error_m) {
  d.lines = 1;
  if (plant.line_levels.empty()) return;
  const double level = 1 + std::log2(error_m / static_cast<double>(plant.line_levels.front().error_m));
  const auto last = static_cast<double>(plant.line_levels.size());
  d.line_level = static_cast<float>(std::clamp(level, 0.0, last));
  d.lines = plant.leaves.empty() ? 1 : static_cast<float>(std::clamp(last + 1 - level, 0.0, 1.0));
}

}  // namespace

void set_leaves(Detail& d, double share, double scale) {
  const double fade = static_cast<double>(glsl::kLeafFade) * std::min(1.0, 4 * (1 - share));
  d.share = static_cast<float>(std::min(1.0, share / (1 - fade / 2)));
  d.scale = static_cast<float>(scale);
  d.fade = static_cast<float>(fade);
}

Detail show_all() {
  Detail d{};
  d.share = d.scale = d.lines = 1;
  return d;
}

Detail show_ours(const PreparedPlant& plant, const LawMeasures& m, double error_m) {
  Detail d{};
  const double scale = m.quad_m > 0 ? std::max(1.0, kLeastQuad * error_m / m.quad_m) : 1;
  set_leaves(d, share_for_scale(plant.leaf_scale, scale), scale);
  set_points(d, plant, error_m);
  d.to_lines = static_cast<float>(share_of_lines(m, error_m));
  const double side_m = m.thin.length_m > 0 ? m.thin.length_m : m.quad_m;
  d.to_points = static_cast<float>(share_of_points(plant, d, side_m / error_m));
  d.point_gain *= static_cast<float>(on_the_way(plant.turning, static_cast<double>(d.to_points)));
  d.bark = static_cast<float>(mesh_level(m, error_m));
  set_lines(d, plant, error_m);
  return d;
}

double error_of_points(const PreparedPlant& plant, double points) {
  return std::sqrt(kPointsAPixel * static_cast<double>(plant.cover_m2) / points);
}

}  // namespace manzana::foliage
