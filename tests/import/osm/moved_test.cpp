// A block moved across the 180th meridian and round the pole keeps its counts and its shapes.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <string>

#include "scenegraph/import/osm_file.h"
#include "tests/support/data.h"

using namespace manzana;

namespace {

// Coordinates in files have steps of 1e-7 degrees, 1.1 cm: so much can either end of a distance be off, both ways.
constexpr double kStep = 0.032;
// The moved files were made on a sphere: their metres are off by up to this share.
constexpr double kSphere = 0.007;

/// The moved files were made without relations.
std::vector<BuildingFeature> of_ways(const CityFeatures& city) {
  std::vector<BuildingFeature> out;
  for (const BuildingFeature& b : city.buildings)
    if (b.where.starts_with("way")) out.push_back(b);
  return out;
}

std::vector<double> side_lengths(const std::vector<Vec2d>& ring) {
  std::vector<double> out;
  for (std::size_t i = 0; i < ring.size(); ++i) out.push_back(glm::length(ring[(i + 1) % ring.size()] - ring[i]));
  return out;
}

void check_alike(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).margin(kStep + kSphere * b[i]));
}

}  // namespace

TEST_CASE("a block moved across the antimeridian and to the pole is the same block") {
  const auto name = GENERATE("broken/osm/antimeridian-block.osm", "broken/osm/polar-block.osm");
  CAPTURE(name);
  const auto here_file = data_file("tiny/helsinki-block.osm");
  if (!here_file) return;
  const CityFeatures here = read_osm(*here_file, {}), there = read_osm(*data_file(name), {});
  const auto old_houses = of_ways(here), houses = of_ways(there);
  REQUIRE(houses.size() == old_houses.size());
  REQUIRE(houses.size() == there.buildings.size());
  REQUIRE(there.streets.size() == here.streets.size());
  REQUIRE(there.trees.size() == here.trees.size());
  CHECK(there.areas.size() == here.areas.size());
  for (std::size_t i = 0; i < houses.size(); ++i) {
    CAPTURE(houses[i].where);
    REQUIRE(houses[i].footprint.outer.size() == old_houses[i].footprint.outer.size());
    check_alike(side_lengths(houses[i].footprint.outer), side_lengths(old_houses[i].footprint.outer));
    CHECK(houses[i].wall_rgb == old_houses[i].wall_rgb);
    CHECK(houses[i].levels == old_houses[i].levels);
  }
  std::vector<double> now, before;
  for (std::size_t i = 0; i < there.trees.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      now.push_back(glm::length(there.trees[i].position - there.trees[j].position));
      before.push_back(glm::length(here.trees[i].position - here.trees[j].position));
    }
  check_alike(now, before);
  for (const StreetFeature& street : there.streets)
    for (const Vec2d& p : street.line) CHECK(glm::length(p) < 1000);
}

TEST_CASE("a square of 100 m is one anywhere on the Earth") {
  const auto place = GENERATE(GeoPoint{60.168, 24.944, 0}, GeoPoint{0, 180, 0}, GeoPoint{-16.8, -179.99999, 0},
                              GeoPoint{89.9999, 33, 0}, GeoPoint{90, 0, 0}, GeoPoint{-90, 0, 0}, GeoPoint{0, 0, 0});
  CAPTURE(place.lat_deg, place.lon_deg);
  const LocalFrame frame(place);
  std::string xml = "<osm version='0.6'>";
  int id = 0;
  for (const Vec2d p : {Vec2d{-50, -50}, Vec2d{50, -50}, Vec2d{50, 50}, Vec2d{-50, 50}}) {
    const GeoPoint at = frame.to_geo({p.x, p.y, frame.ground_z(p)});
    char node[128];
    std::snprintf(node, sizeof node, "<node id='%d' lat='%.7f' lon='%.7f'/>", ++id, at.lat_deg, at.lon_deg);
    xml += node;
  }
  xml +=
      "<way id='1'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='4'/><nd ref='1'/><tag k='building' "
      "v='yes'/></way></osm>";
  const CityFeatures city = read_osm_bytes(xml, "osm", "square");
  REQUIRE(city.buildings.size() == 1);
  const auto& ring = city.buildings[0].footprint.outer;
  REQUIRE(ring.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(glm::length(ring[(i + 1) % 4] - ring[i]) == Approx(100).margin(kStep));
    CHECK(glm::length(ring[i]) == Approx(50 * std::sqrt(2.0)).margin(kStep));
  }
  CHECK(city.areas.empty());
}
