// The village of data/: made up so that every tag the importer knows occurs in it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "tests/import/osm/written.h"

using namespace manzana;
using written::from;

namespace {

CityFeatures village() { return read_osm(VILLAGE_FILE, {}); }

template <class Features, class Wanted>
std::size_t count(const Features& features, Wanted wanted) {
  return static_cast<std::size_t>(std::ranges::count_if(features, wanted));
}

}  // namespace

TEST_CASE("the village has no fault and needs no credit") {
  const CityFeatures city = village();
  for (const Issue& issue : city.issues) FAIL_CHECK(issue.where << ": " << issue.what);
  CHECK(city.attribution.empty());
  CHECK(city.buildings.size() > 70);
  CHECK(city.trees.size() > 90);
}

TEST_CASE("the village has every kind of thing") {
  const CityFeatures city = village();
  std::set<RoofShape> roofs;
  std::set<StreetClass> streets;
  std::set<PlantKind> plants;
  std::set<Material> grounds;
  for (const auto& b : city.buildings) roofs.insert(b.roof);
  for (const auto& s : city.streets) streets.insert(s.kind);
  for (const auto& t : city.trees) plants.insert(t.kind);
  for (const auto& a : city.areas) grounds.insert(a.kind);
  CHECK(roofs.size() == 6);
  CHECK(plants.size() == 3);
  CHECK(streets == std::set{StreetClass::primary, StreetClass::secondary, StreetClass::residential,
                            StreetClass::service, StreetClass::pedestrian, StreetClass::path, StreetClass::track});
  CHECK(grounds == std::set{Material::grass, Material::park, Material::wood, Material::farmland, Material::sand,
                            Material::water, Material::pavement});
  CHECK(count(city.streets, [](const auto& s) { return s.bridge; }) == 4);
  CHECK(count(city.streets, [](const auto& s) { return s.tunnel; }) == 1);
  CHECK(count(city.streets, [](const auto& s) { return s.one_way; }) == 3);
  CHECK(count(city.buildings, [](const auto& b) { return !b.footprint.holes.empty(); }) == 1);
  CHECK(count(city.areas, [](const auto& a) { return !a.shape.holes.empty(); }) == 2);
  CHECK(count(city.areas, [](const auto& a) { return a.mixed; }) >= 1);
}

TEST_CASE("the church is drawn by its parts, and the gate stands over its lane") {
  const CityFeatures city = village();
  CHECK(count(city.buildings, [](const auto& b) { return b.where.find("building:part") != std::string::npos; }) == 9);
  CHECK(count(city.buildings, [](const auto& b) { return b.min_height == 4.5; }) == 1);
  const auto spire = std::ranges::max_element(city.buildings, {}, &BuildingFeature::height);
  CHECK(spire->height == 38);
  CHECK(spire->min_height == 26);
  CHECK(spire->roof == RoofShape::pyramidal);
}
