// building and building:part to features: shapes, heights, roofs, colours, parts.
#include <catch2/catch.hpp>
#include <cmath>

#include "scenegraph/import/defaults.h"
#include "scenegraph/import/osm_shapes.h"
#include "tests/import/osm/written.h"

using namespace manzana;
using written::from;
using written::listed;
using written::Tags;
using written::Written;

namespace {

constexpr double kNodeStep = 0.02;  // metres: coordinates of nodes have steps of 1e-7 degrees

BuildingFeature only_building(const Tags& tags) {
  Written osm;
  osm.way(10, osm.ring({{0, 0}, {20, 0}, {20, 10}, {0, 10}}), tags);
  const CityFeatures city = osm.read();
  REQUIRE(city.buildings.size() == 1);
  return city.buildings[0];
}

}  // namespace

TEST_CASE("a footprint lies where its nodes lie, in metres") {
  const BuildingFeature b = only_building({{"building", "yes"}});
  CHECK(b.where == "way 10 (building)");
  REQUIRE(b.footprint.outer.size() == 4);
  CHECK(area_of(b.footprint) == Approx(200).epsilon(0.004));
  CHECK(glm::length(b.footprint.outer[1] - b.footprint.outer[0]) == Approx(20).margin(kNodeStep + 0.05));
  CHECK(b.footprint.outer[1].x > b.footprint.outer[0].x);  // east
  CHECK(b.footprint.outer[2].y > b.footprint.outer[1].y);  // north
}

TEST_CASE("told heights count") {
  const BuildingFeature b =
      only_building({{"building", "house"}, {"height", "9.5"}, {"roof:shape", "gabled"}, {"roof:height", "3"}});
  CHECK(b.height == Approx(9.5));
  CHECK(b.roof_height == Approx(3));
  CHECK(b.roof == RoofShape::gabled);
  CHECK(b.levels == 2);
  const BuildingFeature up = only_building({{"building", "yes"},
                                            {"height", "20"},
                                            {"min_height", "8"},
                                            {"building:levels", "6"},
                                            {"building:min_level", "2"}});
  CHECK(up.min_height == Approx(8));
  CHECK(up.levels == 4);
  CHECK(only_building({{"building", "yes"}, {"building:levels", "5"}, {"roof:shape", "flat"}}).height == Approx(15.5));
  CHECK(only_building({{"building:part", "yes"}, {"building:min_level", "3"}, {"building:levels", "5"}}).min_height ==
        Approx(9));
}

TEST_CASE("a floor above the roof is mended with an issue") {
  Written osm;
  osm.way(10, osm.ring({{0, 0}, {20, 0}, {20, 10}, {0, 10}}),
          {{"building", "yes"}, {"height", "5"}, {"min_height", "9"}});
  const CityFeatures city = osm.read();
  REQUIRE(city.buildings.size() == 1);
  CHECK(city.buildings[0].min_height == 0);
  CHECK(listed(city, "way 10 (building)", "lowest floor"));
}

TEST_CASE("roof shapes and their nearest") {
  struct Row {
    const char* name;
    RoofShape shape;
  };
  const auto row =
      GENERATE(Row{"flat", RoofShape::flat}, Row{"gabled", RoofShape::gabled}, Row{"hipped", RoofShape::hipped},
               Row{"pyramidal", RoofShape::pyramidal}, Row{"skillion", RoofShape::skillion},
               Row{"dome", RoofShape::dome}, Row{"half-hipped", RoofShape::hipped}, Row{"mansard", RoofShape::hipped},
               Row{"gambrel", RoofShape::gabled}, Row{"onion", RoofShape::dome});
  CAPTURE(row.name);
  const BuildingFeature b = only_building({{"building", "yes"}, {"roof:shape", row.name}});
  CHECK(b.roof == row.shape);
  CHECK((b.roof_height > 0) == (row.shape != RoofShape::flat));
  CHECK(b.height > b.roof_height);
}

TEST_CASE("colours by name, number, material, and by rule") {
  CHECK(only_building({{"building", "yes"}, {"building:colour", "#a0b0c0"}}).wall_rgb == 0xa0b0c0u);
  CHECK(only_building({{"building", "yes"}, {"roof:colour", "maroon"}}).roof_rgb == 0x800000u);
  CHECK(only_building({{"building", "yes"}, {"building:material", "brick"}}).wall_rgb == 0x9a5b43u);
  CHECK(only_building({{"building", "yes"}}).wall_rgb == only_building({{"building", "yes"}}).wall_rgb);
}

TEST_CASE("levels that are not told follow the rule") {
  CHECK(only_building({{"building", "garage"}}).levels == 1);
  CHECK(only_building({{"building", "apartments"}}).levels >= 4);
  const BuildingFeature canopy = only_building({{"building", "roof"}, {"height", "5"}});
  CHECK(canopy.min_height == Approx(4.6));
  // The city's usual: 20 buildings of seven levels make an untold large one of six to eight.
  Written osm;
  for (int i = 0; i < 21; ++i) {
    const double x = 50.0 * i;
    const Tags tags = i == 20 ? Tags{{"building", "yes"}} : Tags{{"building", "yes"}, {"building:levels", "7"}};
    osm.way(100 + i, osm.ring({{x, 0}, {x + 30, 0}, {x + 30, 20}, {x, 20}}), tags);
  }
  const auto last = from(osm.read().buildings, "way 120");
  REQUIRE(last.size() == 1);
  CHECK(std::abs(last[0].levels - 7) <= 1);
}

TEST_CASE("the counter hash is splitmix64") {
  // First output of the reference implementation (Vigna, splitmix64.c) for seed 0 is 0xe220a8397b1dcdaf.
  CHECK(chance(0, 0) == static_cast<double>(0xe220a8397b1dcdafULL >> 11) * 0x1p-53);
  double sum = 0;
  for (std::uint64_t id = 0; id < 10000; ++id) sum += chance(id, 3);
  CHECK(sum / 10000 == Approx(0.5).margin(0.012));  // four standard deviations
}

TEST_CASE("multipolygons: holes, several outers, rings of several ways") {
  Written osm;
  const auto a = osm.line({{0, 0}, {40, 0}, {40, 40}}), b = osm.line({{20, 60}, {0, 40}});
  osm.way(1, a, {});
  osm.way(2, {a[2], b[0], b[1]}, {});
  osm.way(3, {a[0], b[1]}, {});  // against the others' direction
  osm.way(4, osm.ring({{10, 10}, {20, 10}, {20, 20}, {10, 20}}), {});
  osm.way(5, osm.ring({{100, 0}, {120, 0}, {120, 20}, {100, 20}}), {});
  osm.relation(
      7, {{"way", 1, "outer"}, {"way", 3, "outer"}, {"way", 2, "outer"}, {"way", 4, "inner"}, {"way", 5, "outer"}},
      {{"type", "multipolygon"}, {"building", "yes"}});
  const CityFeatures city = osm.read();
  CHECK(city.issues.empty());
  const auto found = from(city.buildings, "relation 7");
  REQUIRE(found.size() == 2);
  CHECK(found[0].footprint.outer.size() == 5);
  REQUIRE(found[0].footprint.holes.size() == 1);
  CHECK(area_of(found[0].footprint) == Approx(40 * 40 + 20 * 40 / 2 - 100 - 0).epsilon(0.005));
  CHECK(found[1].footprint.holes.empty());
}

TEST_CASE("old multipolygons have their tags on the outer way, new ones may repeat them there") {
  Written osm;
  osm.way(1, osm.ring({{0, 0}, {40, 0}, {40, 40}, {0, 40}}), {{"building", "yes"}, {"height", "11"}});
  osm.way(2, osm.ring({{10, 10}, {20, 10}, {20, 20}, {10, 20}}), {});
  osm.relation(7, {{"way", 1, "outer"}, {"way", 2, "inner"}}, {{"type", "multipolygon"}});
  const auto repeat = GENERATE(false, true);
  if (repeat) osm.relation(8, {{"way", 1, "outer"}}, {{"type", "multipolygon"}, {"building", "yes"}});
  const CityFeatures city = osm.read();
  REQUIRE(from(city.buildings, "relation 7").size() == 1);
  CHECK(from(city.buildings, "relation 7")[0].height == Approx(11));
  CHECK(from(city.buildings, "relation 7")[0].footprint.holes.size() == 1);
  CHECK(from(city.buildings, "way 1").empty());
}

TEST_CASE("an outline covered by parts is not drawn, one that is not covered is") {
  Written osm;
  const auto part = GENERATE(6.0, 18.0);  // of 20 m
  osm.way(1, osm.ring({{0, 0}, {20, 0}, {20, 10}, {0, 10}}), {{"building", "yes"}, {"building:colour", "red"}});
  osm.way(2, osm.ring({{0, 0}, {part, 0}, {part, 10}, {0, 10}}), {{"building:part", "yes"}, {"height", "30"}});
  osm.way(3, osm.ring({{0, 0}, {part, 0}, {part, 10}, {0, 10}}),
          {{"building:part", "yes"}, {"height", "34"}, {"min_height", "30"}});
  const CityFeatures city = osm.read();
  CHECK(from(city.buildings, "way 1").size() == (part < 10 ? 1 : 0));
  REQUIRE(from(city.buildings, "way 2").size() == 1);
  CHECK(from(city.buildings, "way 2")[0].wall_rgb == 0xff0000u);  // its outline's
}

TEST_CASE("a relation of type building replaces its outline by its parts") {
  Written osm;
  osm.way(1, osm.ring({{0, 0}, {20, 0}, {20, 10}, {0, 10}}), {{"building", "yes"}});
  osm.way(2, osm.ring({{2, 2}, {6, 2}, {6, 6}, {2, 6}}), {{"building:part", "tower"}, {"height", "30"}});
  const auto with_part = GENERATE(true, false);
  osm.relation(9, {{"way", 1, "outline"}, {"way", with_part ? 2 : 77, "part"}}, {{"type", "building"}});
  const CityFeatures city = osm.read();
  CHECK(from(city.buildings, "way 1").size() == (with_part ? 0 : 1));
  CHECK(from(city.buildings, "way 2").size() == 1);
}

TEST_CASE("what lies under the ground or is no building is passed over") {
  const auto tags = GENERATE(Tags{{"building", "no"}}, Tags{{"building", "yes"}, {"location", "underground"}},
                             Tags{{"building:part", "no"}});
  Written osm;
  osm.way(10, osm.ring({{0, 0}, {20, 0}, {20, 10}, {0, 10}}), tags);
  CHECK(osm.read().buildings.empty());
}
