// Trees, greens, water.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "scenegraph/import/osm_features.h"
#include "scenegraph/import/tree_species.h"
#include "tests/import/osm/written.h"

using namespace manzana;
using written::from;
using written::listed;
using written::Tags;
using written::Written;

namespace {

TreeFeature only_tree(Tags tags) {
  Written osm;
  tags.emplace_back("natural", "tree");
  osm.node(0, 0, tags);
  const CityFeatures city = osm.read();
  REQUIRE(city.trees.size() == 1);
  return city.trees[0];
}

AreaFeature only_area(const Tags& tags) {
  Written osm;
  osm.way(10, osm.ring({{0, 0}, {100, 0}, {100, 50}, {0, 50}}), tags);
  const CityFeatures city = osm.read();
  REQUIRE(city.areas.size() == 1);
  return city.areas[0];
}

}  // namespace

TEST_CASE("kinds of plants") {
  struct Row {
    const char *key, *value;
    PlantKind kind;
  };
  const auto row = GENERATE(
      Row{"leaf_type", "needleleaved", PlantKind::conifer}, Row{"leaf_type", "broadleaved", PlantKind::broadleaf},
      Row{"genus", "Picea", PlantKind::conifer}, Row{"species", "Pinus sylvestris", PlantKind::conifer},
      Row{"species", "Quercus robur", PlantKind::broadleaf},
      Row{"taxon", "Taxus baccata 'Fastigiata'", PlantKind::conifer}, Row{"genus", "Syringa", PlantKind::shrub},
      Row{"leaf_cycle", "evergreen", PlantKind::conifer}, Row{"leaf_cycle", "deciduous", PlantKind::broadleaf},
      Row{"name", "Old one", PlantKind::broadleaf});
  CAPTURE(row.key, row.value);
  CHECK(only_tree({{row.key, row.value}}).kind == row.kind);
}

TEST_CASE("species of trees: by genus, else any of their kind") {
  struct Row {
    const char *key, *value;
    PlantSpecies species;
  };
  const auto row =
      GENERATE(Row{"species", "Quercus robur", PlantSpecies::oak}, Row{"genus", "Betula", PlantSpecies::birch},
               Row{"taxon", "Populus nigra 'Italica'", PlantSpecies::poplar}, Row{"genus", "Pinus", PlantSpecies::pine},
               Row{"genus", "Salix", PlantSpecies::willow}, Row{"species", "Tilia cordata", PlantSpecies::lime},
               Row{"genus", "Phoenix", PlantSpecies::palm}, Row{"species", "Malus domestica", PlantSpecies::apple},
               Row{"genus", "Platanus", PlantSpecies::broadleaf}, Row{"genus", "Picea", PlantSpecies::conifer},
               Row{"genus", "Syringa", PlantSpecies::shrub});
  CAPTURE(row.key, row.value);
  CHECK(only_tree({{row.key, row.value}}).species == row.species);
  const TreeFeature untold = only_tree({{"leaf_type", "needleleaved"}});
  CHECK(kind_of(untold.species.value()) == PlantKind::conifer);
}

TEST_CASE("species of trees: a row has one, many trees have many, and each the same again") {
  std::set<PlantSpecies> of_rows, of_trees;
  for (std::uint64_t id = 0; id < 200; ++id) {
    const PlantSpecies row = species_for(PlantKind::broadleaf, TreePlace::row, id);
    of_rows.insert(row);
    of_trees.insert(species_for(id % 3 == 0 ? PlantKind::conifer : PlantKind::broadleaf, TreePlace::park, id));
    CHECK(species_for(PlantKind::broadleaf, TreePlace::row, id) == row);
  }
  CHECK(of_rows.size() == 5);
  CHECK(of_trees.size() == 9);
  Written osm;
  osm.way(10, osm.line({{0, 0}, {60, 0}}), {{"natural", "tree_row"}});
  const CityFeatures city = osm.read();
  REQUIRE(city.trees.size() > 4);
  for (const TreeFeature& tree : city.trees) CHECK(tree.species == city.trees[0].species);
}

TEST_CASE("sizes of trees: told, by girth, by rule") {
  CHECK(only_tree({{"height", "21,5"}}).height == Approx(21.5));
  CHECK(only_tree({{"diameter_crown", "9"}}).crown_radius == Approx(4.5));
  const double slim = only_tree({{"circumference", "0.3"}}).height,
               stout = only_tree({{"circumference", "2.5"}}).height;
  CHECK(slim < stout);
  CHECK(only_tree({{"circumference", "250"}}).height == Approx(stout));  // typed in centimetres
  CHECK(stout < 31);
  const TreeFeature odd = only_tree({{"height", "1e9"}, {"diameter_crown", "-2"}});
  const TreeHabit habit = habit_of(odd.species.value());
  CHECK((odd.height >= habit.low && odd.height <= habit.high));
  CHECK(odd.crown_radius == Approx(habit.crown * odd.height));
  const TreeFeature plain = only_tree({{"genus", "Platanus"}});
  CHECK((plain.height >= 8 && plain.height <= 15));
  CHECK(plain.crown_radius == Approx(0.27 * plain.height));
}

TEST_CASE("a tree row is a tree every eight metres") {
  Written osm;
  osm.way(10, osm.line({{0, 0}, {60, 0}, {60, 20}}), {{"natural", "tree_row"}, {"leaf_type", "needleleaved"}});
  const CityFeatures city = osm.read();
  REQUIRE(city.trees.size() == 10);
  for (std::size_t i = 0; i < city.trees.size(); ++i) {
    CHECK(city.trees[i].kind == PlantKind::conifer);
    if (i > 0 && i != 7 && i != 8) {
      CHECK(glm::length(city.trees[i].position - city.trees[i - 1].position) == Approx(8).margin(0.05));
    }
  }
}

TEST_CASE("grounds by tag") {
  struct Row {
    const char *key, *value;
    Material kind;
    bool trees;
  };
  const auto row =
      GENERATE(Row{"natural", "wood", Material::wood, true}, Row{"landuse", "forest", Material::wood, true},
               Row{"landuse", "orchard", Material::grass, true}, Row{"natural", "scrub", Material::wood, true},
               Row{"leisure", "park", Material::park, true}, Row{"landuse", "grass", Material::grass, false},
               Row{"natural", "water", Material::water, false}, Row{"waterway", "riverbank", Material::water, false},
               Row{"natural", "beach", Material::sand, false}, Row{"landuse", "farmland", Material::farmland, false},
               Row{"amenity", "parking", Material::pavement, false}, Row{"place", "square", Material::pavement, false});
  CAPTURE(row.key, row.value);
  const AreaFeature area = only_area({{row.key, row.value}});
  CHECK(area.kind == row.kind);
  CHECK((area.trees_per_ha > 0) == row.trees);
}

TEST_CASE("what an area of trees says of its leaves counts") {
  CHECK(only_area({{"natural", "wood"}, {"leaf_type", "needleleaved"}}).tree_kind == PlantKind::conifer);
  CHECK_FALSE(only_area({{"natural", "wood"}, {"leaf_type", "needleleaved"}}).mixed);
  CHECK(only_area({{"natural", "wood"}}).mixed);
  CHECK_FALSE(only_area({{"landuse", "forest"}, {"wood", "deciduous"}}).mixed);
}

TEST_CASE("a river is as wide as it says, and round at its ends") {
  Written osm;
  osm.way(10, osm.line({{0, 0}, {100, 0}}), {{"waterway", "river"}, {"width", "20"}});
  osm.way(11, osm.line({{0, 100}, {100, 100}}), {{"waterway", "stream"}, {"tunnel", "culvert"}});
  osm.way(12, osm.line({{0, 200}, {0, 200}}), {{"waterway", "canal"}});
  const CityFeatures city = osm.read();
  const auto river = from(city.areas, "way 10");
  REQUIRE(river.size() == 1);
  CHECK(river[0].kind == Material::water);
  CHECK(area_of(river[0].shape) == Approx(100 * 20 + std::numbers::pi * 100).epsilon(0.02));
  CHECK(from(city.areas, "way 11").empty());
}

TEST_CASE("a wood with a lake in it, its trees are kept to what can be drawn") {
  Written osm;
  osm.way(1, osm.ring({{0, 0}, {3000, 0}, {3000, 3000}, {0, 3000}}), {});
  osm.way(2, osm.ring({{1000, 1000}, {2000, 1000}, {2000, 2000}, {1000, 2000}}), {{"natural", "water"}});
  osm.relation(7, {{"way", 1, "outer"}, {"way", 2, "inner"}}, {{"type", "multipolygon"}, {"landuse", "forest"}});
  osm.way(3, osm.ring({{3100, 0}, {3200, 0}, {3200, 100}, {3100, 100}}), {{"landuse", "forest"}});
  const CityFeatures city = osm.read();
  REQUIRE(city.areas.size() == 3);
  double trees = 0;
  for (const AreaFeature& area : city.areas) trees += area.trees_per_ha * area_of(area.shape) / 10000;
  CHECK(trees == Approx(kMostScattered));
  CHECK(listed(city, "woods", "thinned"));
  Written grove;
  grove.way(3, grove.ring({{0, 0}, {100, 0}, {100, 100}, {0, 100}}), {{"landuse", "forest"}});
  CHECK(from(city.areas, "way 3").at(0).trees_per_ha == grove.read().areas.at(0).trees_per_ha);  // groves keep theirs
  CHECK(from(city.areas, "way 2").size() == 1);
}

TEST_CASE("strays far from the rest are left out") {
  Written osm;
  for (int i = 0; i < 50; ++i) osm.node(i, i, {{"natural", "tree"}});
  osm.node(4e6, 0, {{"natural", "tree"}});
  const CityFeatures city = osm.read();
  CHECK(city.trees.size() == 50);
  CHECK(listed(city, "node 51", "too far"));
}
