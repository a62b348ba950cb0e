// highway ways to streets.
#include <catch2/catch.hpp>

#include "tests/import/osm/written.h"

using namespace manzana;
using written::from;
using written::Tags;
using written::Written;

namespace {

StreetFeature only_street(const Tags& tags) {
  Written osm;
  osm.way(10, osm.line({{0, 0}, {50, 0}, {100, 20}}), tags);
  const CityFeatures city = osm.read();
  REQUIRE(city.streets.size() == 1);
  return city.streets[0];
}

}  // namespace

TEST_CASE("classes of streets") {
  struct Row {
    const char* highway;
    StreetClass kind;
  };
  const auto row =
      GENERATE(Row{"motorway", StreetClass::motorway}, Row{"trunk", StreetClass::motorway},
               Row{"primary", StreetClass::primary}, Row{"secondary", StreetClass::secondary},
               Row{"tertiary", StreetClass::secondary}, Row{"unclassified", StreetClass::residential},
               Row{"residential", StreetClass::residential}, Row{"living_street", StreetClass::residential},
               Row{"road", StreetClass::residential}, Row{"service", StreetClass::service},
               Row{"pedestrian", StreetClass::pedestrian}, Row{"footway", StreetClass::path},
               Row{"steps", StreetClass::path}, Row{"cycleway", StreetClass::path}, Row{"track", StreetClass::track});
  CAPTURE(row.highway);
  const StreetFeature street = only_street({{"highway", row.highway}});
  CHECK(street.kind == row.kind);
  CHECK(street.where == "way 10 (highway)");
  CHECK(street.width > 0);
}

TEST_CASE("ways that are no streets of the city are passed over") {
  const auto tags =
      GENERATE(Tags{{"highway", "construction"}, {"construction", "primary"}}, Tags{{"highway", "proposed"}},
               Tags{{"highway", "corridor"}}, Tags{{"highway", "footway"}, {"indoor", "yes"}},
               Tags{{"highway", "footway"}, {"level", "-1"}}, Tags{{"highway", "platform"}}, Tags{{"railway", "tram"}},
               Tags{{"highway", "abandoned"}});
  Written osm;
  osm.way(10, osm.line({{0, 0}, {50, 0}}), tags);
  CHECK(osm.read().streets.empty());
}

TEST_CASE("widths come from width, else lanes, else class") {
  CHECK(only_street({{"highway", "residential"}, {"width", "7,5 m"}, {"lanes", "4"}}).width == Approx(7.5));
  CHECK(only_street({{"highway", "primary"}, {"lanes", "4"}}).width == Approx(4 * 3.1));
  CHECK(only_street({{"highway", "primary"}, {"lanes", "4"}}).lanes == 4);
  CHECK(only_street({{"highway", "residential"}}).width == Approx(6));
  CHECK(only_street({{"highway", "residential"}, {"lanes", "many"}, {"width", "-1"}}).width == Approx(6));
}

TEST_CASE("direction: oneway, -1, motorways, roundabouts") {
  CHECK_FALSE(only_street({{"highway", "residential"}}).one_way);
  CHECK(only_street({{"highway", "residential"}, {"oneway", "yes"}}).one_way);
  CHECK(only_street({{"highway", "motorway"}}).one_way);
  CHECK_FALSE(only_street({{"highway", "motorway"}, {"oneway", "no"}}).one_way);
  CHECK(only_street({{"highway", "residential"}, {"junction", "roundabout"}}).one_way);
  const StreetFeature along = only_street({{"highway", "residential"}, {"oneway", "yes"}});
  const StreetFeature against = only_street({{"highway", "residential"}, {"oneway", "-1"}});
  CHECK(against.one_way);
  REQUIRE(against.nodes.size() == 3);
  CHECK(std::equal(against.nodes.rbegin(), against.nodes.rend(), along.nodes.begin()));
  CHECK(against.line.front() == along.line.back());
}

TEST_CASE("bridges, tunnels, layers") {
  const StreetFeature bridge = only_street({{"highway", "primary"}, {"bridge", "viaduct"}, {"layer", "2"}});
  CHECK(bridge.bridge);
  CHECK(bridge.layer == 2);
  CHECK(only_street({{"highway", "primary"}, {"bridge", "yes"}}).layer == 1);
  CHECK(only_street({{"highway", "primary"}, {"tunnel", "yes"}}).tunnel);
  CHECK(only_street({{"highway", "primary"}, {"tunnel", "yes"}}).layer == -1);
  CHECK_FALSE(only_street({{"highway", "primary"}, {"bridge", "no"}}).bridge);
}

TEST_CASE("streets keep the nodes that exist") {
  Written osm;
  auto refs = osm.line({{0, 0}, {50, 0}, {100, 0}});
  refs.insert(refs.begin() + 1, 999);
  osm.way(10, refs, {{"highway", "residential"}});
  osm.way(11, {998, 999, refs[0]}, {{"highway", "residential"}});
  const CityFeatures city = osm.read();
  REQUIRE(city.streets.size() == 1);
  CHECK(city.streets[0].line.size() == 3);
  CHECK(written::listed(city, "way 10", "1 nodes are not in the file"));
  CHECK(written::listed(city, "way 11", "fewer than two nodes"));
}

TEST_CASE("squares are grounds, not streets") {
  Written osm;
  const auto ring = osm.ring({{0, 0}, {40, 0}, {40, 30}, {0, 30}});
  osm.way(10, ring, {{"highway", "pedestrian"}, {"area", "yes"}});
  const CityFeatures city = osm.read();
  CHECK(city.streets.empty());
  REQUIRE(city.areas.size() == 1);
  CHECK(city.areas[0].kind == Material::pavement);
}

TEST_CASE("left-hand traffic only where it is told") {
  Written osm;
  osm.way(10, osm.line({{0, 0}, {50, 0}}), {{"highway", "residential"}, {"driving_side", "left"}});
  CHECK(osm.read().left_hand_traffic);
  CHECK_FALSE(Written().read().left_hand_traffic);
}
