#include "scenegraph/import/tree_species.h"

#include <algorithm>
#include <array>
#include <span>

#include "culling/hash.h"

namespace manzana {
namespace {

using enum PlantSpecies;

struct Share {
  PlantSpecies species;
  unsigned of_hundred;
};
constexpr std::array<Share, 7> kPark{
    {{broadleaf, 24}, {oak, 20}, {birch, 18}, {lime, 18}, {willow, 8}, {poplar, 6}, {apple, 6}}};
constexpr std::array<Share, 5> kRow{{{lime, 34}, {broadleaf, 30}, {oak, 14}, {birch, 12}, {poplar, 10}}};
constexpr std::array<Share, 5> kGarden{{{apple, 36}, {birch, 22}, {broadleaf, 22}, {lime, 10}, {willow, 10}}};
constexpr std::array<Share, 4> kWood{{{oak, 34}, {broadleaf, 28}, {birch, 26}, {lime, 12}}};
constexpr std::array<Share, 2> kNeedles{{{conifer, 60}, {pine, 40}}};

std::span<const Share> leafy(TreePlace place) {
  switch (place) {
    case TreePlace::row:
      return kRow;
    case TreePlace::garden:
      return kGarden;
    case TreePlace::wood:
      return kWood;
    case TreePlace::park:
      break;
  }
  return kPark;
}

PlantSpecies pick(std::span<const Share> shares, std::uint64_t identity) {
  std::uint64_t left = hash_bits(identity, 0x7ee) % 100;
  for (const Share& share : shares) {
    if (left < share.of_hundred) return share.species;
    left -= share.of_hundred;
  }
  return shares.front().species;
}

struct Genus {
  std::string_view name;
  PlantSpecies species;
};
// Palms are not one genus: those that stand in towns.
constexpr std::array<Genus, 21> kGenera{
    {{"quercus", oak},   {"betula", birch},      {"populus", poplar},    {"pinus", pine},      {"salix", willow},
     {"tilia", lime},    {"malus", apple},       {"pyrus", apple},       {"prunus", apple},    {"cydonia", apple},
     {"phoenix", palm},  {"trachycarpus", palm}, {"washingtonia", palm}, {"chamaerops", palm}, {"syagrus", palm},
     {"jubaea", palm},   {"cocos", palm},        {"butia", palm},        {"livistona", palm},  {"brahea", palm},
     {"roystonea", palm}}};

// Genera, in lower case.
constexpr std::array<std::string_view, 26> kConifers{
    "abies",       "araucaria",  "calocedrus",  "cedrus",      "cephalotaxus", "chamaecyparis", "cryptomeria",
    "cupressus",   "fitzroya",   "juniperus",   "larix",       "metasequoia",  "picea",         "pinus",
    "platycladus", "podocarpus", "pseudolarix", "pseudotsuga", "sciadopitys",  "sequoia",       "sequoiadendron",
    "taxodium",    "taxus",      "thuja",       "thujopsis",   "tsuga"};
constexpr std::array<std::string_view, 20> kShrubs{
    "amelanchier",  "berberis",  "buxus",     "cornus",    "corylus",  "cotoneaster", "forsythia",
    "frangula",     "hydrangea", "lavandula", "ligustrum", "lonicera", "nerium",      "philadelphus",
    "rhododendron", "ribes",     "rosa",      "spiraea",   "syringa",  "viburnum"};

}  // namespace

std::string genus_in(std::string_view name) {
  std::string genus(name.substr(0, name.find_first_of(" ;,_")));
  for (char& c : genus) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return genus;
}

std::optional<PlantKind> kind_of_name(std::string_view name) {
  const std::string genus = genus_in(name);
  if (std::ranges::find(kConifers, genus) != kConifers.end()) return PlantKind::conifer;
  if (std::ranges::find(kShrubs, genus) != kShrubs.end()) return PlantKind::shrub;
  return genus.empty() ? std::nullopt : std::optional(PlantKind::broadleaf);
}

std::optional<PlantSpecies> species_named(std::string_view name) {
  const auto kind = kind_of_name(name);
  if (!kind) return std::nullopt;
  const PlantSpecies species = species_of_genus(genus_in(name)).value_or(plain_species(*kind));
  return kind_of(species) == *kind ? species : plain_species(*kind);
}

PlantSpecies species_for(PlantKind kind, TreePlace place, std::uint64_t identity) {
  if (kind == PlantKind::shrub) return shrub;
  return pick(kind == PlantKind::conifer ? std::span<const Share>(kNeedles) : leafy(place), identity);
}

std::optional<PlantSpecies> species_of_genus(std::string_view genus) {
  const auto found = std::ranges::find(kGenera, genus, &Genus::name);
  return found == kGenera.end() ? std::nullopt : std::optional(found->species);
}

TreeHabit habit_of(PlantSpecies species) {
  switch (species) {
    case conifer:
      return {12, 20, 0.17};
    case shrub:
      return {1.2, 2.5, 0.5};
    case oak:
      return {9, 16, 0.36};
    case birch:
      return {9, 16, 0.19};
    case poplar:
      return {13, 23, 0.11};
    case pine:
      return {10, 18, 0.24};
    case willow:
      return {7, 12, 0.36};
    case lime:
      return {9, 17, 0.25};
    case palm:
      return {6, 11, 0.34};
    case apple:
      return {3.5, 6, 0.42};
    case broadleaf:
    case PlantSpecies::count:
      break;
  }
  return {8, 15, 0.27};
}

std::array<bool, kPlantSpecies> species_in(const Scene& scene) {
  std::array<bool, kPlantSpecies> stands{};
  for (const TreeInstance& tree : scene.trees.instances)
    if (tree.plant < kPlantSpecies) stands[tree.plant] = true;
  return stands;
}

TreeFeature free_tree(const Vec2d& at, double height, PlantSpecies species) {
  constexpr double kWider = 1.3;
  const PlantKind kind = kind_of(species);
  const TreeHabit habit = habit_of(species), plain = habit_of(plain_species(kind));
  const double own = height * habit.high / plain.high;
  return {at, own, kWider * habit.crown * own, kind, species};
}

}  // namespace manzana
