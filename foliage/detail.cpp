#include "foliage/detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "foliage/laws.h"
#include "foliage/leaf_quads.h"
#include "foliage/lod_factor.h"

namespace manzana::foliage {
namespace {

constexpr std::array kLaws{Law::full, Law::ours, Law::prune, Law::ramp, Law::points_and_lines, Law::levels};
constexpr std::array kNames{"full", "ours", "gumbau", "gumbau-ramp", "deussen", "gadbem"};

/// The error that row i of the table stands for: four rows an octave of its square, linear in between.
double error_of(std::uint32_t row) {
  return std::sqrt(std::ldexp(1 + 0.25 * (row % 4), static_cast<int>(row / 4) - 32));
}

/// Of distances at which a leaf quad is smaller than the error so many times.
double share_left(Law law, double times_smaller) {
  static const PowerFactor power(std::sqrt(2.0));  // a constant number of leaves a pixel
  static const LinearRamp ramp(1, 10, 0.1);
  return law == Law::prune ? power.at(times_smaller) : ramp.at(times_smaller);
}

Detail detail_of(const PreparedPlant& plant, const LawMeasures& m, double error_m, Law law) {
  switch (law) {
    case Law::full:
      break;
    case Law::ours:
      return show_ours(plant, m, error_m);
    case Law::prune:
    case Law::ramp:
      return show_pruned(plant, share_left(law, m.quad_m > 0 ? error_m / m.quad_m : 1));
    case Law::points_and_lines:
      return show_points_and_lines(plant, error_m);
    case Law::levels:
      return show_levels(plant, m, error_m);
  }
  return show_all();
}

}  // namespace

LawMeasures measure_for_laws(const PreparedPlant& plant) {
  LawMeasures m;
  for (const PlantQuad& quad : plant.leaves) m.quad_m += quad_area(quad);
  if (!plant.leaves.empty()) m.quad_m = std::sqrt(m.quad_m / static_cast<double>(plant.leaves.size()));
  for (const BranchLevel& level : plant.branch_levels) m.widths_m.push_back(static_cast<double>(level.error_m));
  m.thin = leaf_line_size(plant);
  float widest = 0;
  for (const LineSegment& line : plant.lines)
    if (line.branch != kOfLeaf) widest = std::max({widest, line.radius_a, line.radius_b});
  m.widths_m.push_back(2 * static_cast<double>(widest));
  return m;
}

std::span<const Law> all_laws() { return kLaws; }

Law law_named(std::string_view name) {
  for (const Law law : kLaws)
    if (name == name_of(law)) return law;
  std::string names;
  for (const char* known : kNames) names += std::string(names.empty() ? "" : ", ") + known;
  throw std::invalid_argument("no law of detail is named \"" + std::string(name) + "\": " + names);
}

const char* name_of(Law law) { return kNames[static_cast<std::size_t>(law)]; }

std::vector<Detail> make_details(std::span<const PreparedPlant> plants, Law law) {
  std::vector<Detail> details;
  details.reserve(plants.size() * glsl::kDetailSteps);
  for (const PreparedPlant& plant : plants) {
    const LawMeasures m = measure_for_laws(plant);
    for (std::uint32_t row = 0; row < glsl::kDetailSteps; ++row)
      details.push_back(detail_of(plant, m, error_of(row), law));
  }
  return details;
}

}  // namespace manzana::foliage
