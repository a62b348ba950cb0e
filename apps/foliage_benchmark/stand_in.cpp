#include "apps/foliage_benchmark/stand_in.h"

namespace manzana::foliage_benchmark {
namespace {

double triangles_of(const foliage::Plant& plant) {
  return static_cast<double>(plant.mesh.bark.triangles() + plant.mesh.leaves.triangles());
}

double mean_length(const foliage::Plant& plant, std::uint16_t level) {
  double sum = 0, branches = 0;
  for (const foliage::Branch& branch : plant.branches) {
    if (branch.level != level || branch.line.size() < 2) continue;
    for (std::uint32_t i = branch.line.first + 1; i < branch.line.last; ++i)
      sum += static_cast<double>(glm::distance(plant.centre_lines[i - 1].position, plant.centre_lines[i].position));
    ++branches;
  }
  return sum / std::max(1.0, branches);
}

/// Twigs in place of cards, as long as those are, with the cards' angles.
void add_twigs(foliage::SpeciesParams& species, const foliage::Plant& by_nature) {
  const auto level = static_cast<std::size_t>(species.levels++);
  foliage::StemParams& twig = species.stems[level];
  twig.branches = species.leaves;
  twig.length = static_cast<float>(static_cast<double>(species.leaf_scale) /
                                   mean_length(by_nature, static_cast<std::uint16_t>(level - 1)));
  twig.curve_res = 1;
  if (level + 1 < species.stems.size())
    species.stems[level + 1] = {.down_angle = 50, .down_angle_v = 20, .rotate = 137.5F, .rotate_v = 45};
}

}  // namespace

foliage::Plant grown_dense(std::string_view species_name, double triangles) {
  constexpr double kMostOnAStem = 20;  // times as many as by nature: beyond that they would hide the stems alone
  foliage::SpeciesParams species = foliage::builtin_species(species_name);
  foliage::Plant plant = grow_plant(species, 1);
  const auto cards = static_cast<double>(plant.mesh.leaves.triangles());
  const double area = static_cast<double>(species.leaf_scale * species.leaf_scale) * cards;
  if (triangles > kMostOnAStem * cards) {
    add_twigs(species, plant);
    species.leaves = std::max(1, static_cast<int>(std::lround(triangles / cards)));
    species.leaf_scale = static_cast<float>(std::sqrt(area / triangles));
    plant = grow_plant(species, 1);
  }
  const auto leaves = static_cast<double>(plant.mesh.leaves.triangles());
  const double wanted = triangles - (triangles_of(plant) - leaves);
  species.leaves = std::max(1, static_cast<int>(std::lround(species.leaves * wanted / leaves)));
  species.leaf_scale = static_cast<float>(std::sqrt(area / wanted));
  return grow_plant(species, 1);
}

}  // namespace manzana::foliage_benchmark
