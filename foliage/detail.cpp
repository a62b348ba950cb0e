#include "foliage/detail.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace manzana::foliage {
namespace {

/// What the laws ask of a plant.
struct Measures {
  double quad = 0;  ///< side of a mean leaf quad, metres
};

double quad_area(const PlantQuad& quad) {
  const auto corner = [&](std::size_t i) { return quad.corners[i].position; };
  const auto triangle = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return glm::length(glm::cross(b - a, c - a)) / 2;
  };
  return static_cast<double>(triangle(corner(0), corner(1), corner(2)) + triangle(corner(0), corner(2), corner(3)));
}

Measures measure(const PreparedPlant& plant) {
  Measures m;
  for (const PlantQuad& quad : plant.leaves) m.quad += quad_area(quad);
  if (!plant.leaves.empty()) m.quad = std::sqrt(m.quad / static_cast<double>(plant.leaves.size()));
  return m;
}

/// The share at which leaves scaled by s cover what all of them did: leaf_scale read backwards, linear in log u.
double share_for_scale(const std::array<float, 17>& scale, double s) {
  if (s <= 1) return 1;
  for (std::size_t i = 0; i + 1 < scale.size(); ++i) {
    const auto a = static_cast<double>(scale[i]), b = static_cast<double>(scale[i + 1]);
    if (s < b) return std::exp2(-0.5 * (static_cast<double>(i) + (b > a ? std::max(0.0, s - a) / (b - a) : 0)));
  }
  return std::exp2(-8);
}

double scale_for_share(const std::array<float, 17>& scale, double u) {
  const double at = std::clamp(-2 * std::log2(std::max(u, 1e-9)), 0.0, 16.0);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), 15);
  return std::lerp(static_cast<double>(scale[i]), static_cast<double>(scale[i + 1]), at - static_cast<double>(i));
}

/// Leaves that shrink away at the boundary cover less by half their share, so as many more are shown.
void set_leaves(Detail& d, double share, double scale) {
  constexpr double kFade = 0.3;
  const double fade = kFade * std::min(1.0, 4 * (1 - share));
  d.share = static_cast<float>(std::min(1.0, share / (1 - fade / 2)));
  d.scale = static_cast<float>(scale);
  d.fade = static_cast<float>(fade);
}

/// m2 that points must show to cover what the leaves do, where p of them are: between levels by log p.
double area_at(const std::vector<PointLevel>& levels, double p) {
  std::size_t i = 0;
  while (i + 1 < levels.size() && p <= static_cast<double>(levels[i + 1].points.size())) ++i;
  const auto area = [&](std::size_t level) { return static_cast<double>(levels[level].area); };
  if (i + 1 == levels.size()) return area(i);
  const double n = levels[i].points.size(), m = levels[i + 1].points.size();
  return std::lerp(area(i), area(i + 1), std::clamp(std::log(n / p) / std::log(n / m), 0.0, 1.0));
}

/// [Deussen 2005, equation 10.5] as many points as cover the leaves' area, each as large as their spacing d'.
void set_points(Detail& d, const PreparedPlant& plant, double spacing) {
  const std::vector<PointLevel>& levels = plant.point_levels;
  if (levels.empty()) return;
  const auto size = [&](std::size_t level) { return static_cast<double>(levels[level].points.size()); };
  double p = size(0);
  for (int round = 0; round < 8; ++round) p = std::clamp(area_at(levels, p) / (spacing * spacing), 1e-3, size(0));
  std::size_t level = 0;
  while (level + 1 < levels.size() && p <= size(level + 1)) ++level;
  const bool last = level + 1 == levels.size();
  const double x = last ? 0 : std::clamp((size(level) - p) / (size(level) - size(level + 1)), 0.0, 1.0);
  d.points = static_cast<float>(p);
  d.point_level = static_cast<float>(static_cast<double>(level) + x);
  d.point_gain = static_cast<float>(1 / p);
}

/// Metres, of the branches that are lines at a level; beyond the last level all are.
double widest_line(const PreparedPlant& plant, std::size_t level) {
  if (level < plant.branch_levels.size()) return static_cast<double>(plant.branch_levels[level].error_m);
  float radius = 0;
  for (const LineSegment& line : plant.lines) radius = std::max({radius, line.radius_a, line.radius_b});
  return 2 * static_cast<double>(radius);
}

/// Branches thinner than a fraction of the error are not worth a line; meshes give way to lines where those are thin,
/// one branch after the other.
void set_branches(Detail& d, const PreparedPlant& plant, double error_m) {
  constexpr double kThinnest = 0.15, kThickest = 1.25, kFirst = 0.6;
  std::size_t lines = plant.lines.size();
  const auto thin = [&](const LineSegment& line) {
    return 2 * static_cast<double>(std::max(line.radius_a, line.radius_b)) < kThinnest * error_m;
  };
  while (lines > 0 && thin(plant.lines[lines - 1])) --lines;
  d.lines = static_cast<float>(lines);
  double level = 0;
  for (std::size_t next = 1; next <= plant.branch_levels.size(); ++next) {
    const double width = kThickest * error_m / std::max(1e-9, widest_line(plant, next));
    level = std::max(level, static_cast<double>(next - 1) + std::clamp((width - kFirst) / (1 - kFirst), 0.0, 1.0));
    if (width < 1) break;
  }
  d.bark = static_cast<float>(level);
}

void show_all(Detail& d, const PreparedPlant& plant) {
  set_leaves(d, 1, 1);
  d.lines = static_cast<float>(plant.lines.size());
}

// Leaf quads of at least this many times the error; points from there to the other.
constexpr double kQuadSize = 4, kPointSize = 2;

void show_ours(Detail& d, const PreparedPlant& plant, const Measures& m, double error_m) {
  const double scale = std::max(1.0, 0.75 * error_m / m.quad);
  set_leaves(d, share_for_scale(plant.leaf_scale, scale), scale);
  set_points(d, plant, error_m);
  if (!plant.point_levels.empty() && m.quad > 0)
    d.to_points = static_cast<float>(std::clamp((kQuadSize - m.quad / error_m) / (kQuadSize - kPointSize), 0.0, 1.0));
  set_branches(d, plant, error_m);
}

/// z = 1 where a leaf quad is as large as the error; h = sqrt 2, a constant number of leaves a pixel.
void show_pruned(Detail& d, const PreparedPlant& plant, const Measures& m, double error_m) {
  const double z = m.quad > 0 ? error_m / m.quad : 1;
  const double u = z <= 1 ? 1 : 1 / (z * z);
  set_leaves(d, u, scale_for_share(plant.leaf_scale, u));
  d.hidden = 1;
  d.lines = static_cast<float>(plant.lines.size());
}

Detail detail_of(const PreparedPlant& plant, const Measures& m, double error_m, Law law) {
  Detail d{};
  switch (law) {
    case Law::full:
      show_all(d, plant);
      break;
    case Law::ours:
      show_ours(d, plant, m, error_m);
      break;
    case Law::prune:
      show_pruned(d, plant, m, error_m);
      break;
  }
  return d;
}

/// The error that row i of the table stands for: four rows an octave of its square, linear in between.
double error_of(std::uint32_t row) {
  return std::sqrt(std::ldexp(1 + 0.25 * (row % 4), static_cast<int>(row / 4) - 32));
}

}  // namespace

Law law_named(std::string_view name) {
  for (const Law law : {Law::full, Law::ours, Law::prune})
    if (name == name_of(law)) return law;
  throw std::invalid_argument("no law of detail is named \"" + std::string(name) + "\": full, ours or gumbau");
}

const char* name_of(Law law) {
  switch (law) {
    case Law::full:
      return "full";
    case Law::ours:
      return "ours";
    case Law::prune:
      return "gumbau";
  }
  return "";
}

std::vector<Detail> make_details(std::span<const PreparedPlant> plants, Law law) {
  std::vector<Detail> details;
  details.reserve(plants.size() * glsl::kDetailSteps);
  for (const PreparedPlant& plant : plants) {
    const Measures m = measure(plant);
    for (std::uint32_t row = 0; row < glsl::kDetailSteps; ++row)
      details.push_back(detail_of(plant, m, error_of(row), law));
  }
  return details;
}

}  // namespace manzana::foliage
