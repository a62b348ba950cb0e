// Several sources in one scene.
#include <catch2/catch.hpp>
#include <set>

#include "tests/import/cityjson/made.h"

using namespace manzana;

TEST_CASE("what is merged stays where it is on the Earth") {
  CityFeatures into, more;
  into.frame = LocalFrame({48.1, 11.5, 0});
  more.frame = LocalFrame({48.3, 11.8, 0});
  more.trees.push_back({.position = {120, -340}});
  more.areas.push_back({.where = "meadow", .shape = {{{0, 0}, {10, 0}, {0, 10}}, {}}});
  ConstructionFeature work;
  work.points = {{5, 6, 7}};
  more.constructions.push_back(work);
  more.buildings.push_back({.where = "hut", .footprint = {{{1, 2}, {3, 4}, {5, 9}}, {}}});
  const CityFeatures before = more;
  merge(into, more);
  const auto same = [&](const Vec2d& now, const Vec2d& then) {
    const GeoPoint a = into.frame.to_geo({now, into.frame.ground_z(now)});
    const GeoPoint b = before.frame.to_geo({then, before.frame.ground_z(then)});
    CHECK(a.lat_deg == Approx(b.lat_deg).margin(1e-9));
    CHECK(a.lon_deg == Approx(b.lon_deg).margin(1e-9));
  };
  REQUIRE(into.trees.size() == 1);
  same(into.trees[0].position, {120, -340});
  same(into.areas.at(0).shape.outer[1], {10, 0});
  same(Vec2d(into.constructions.at(0).points[0]), {5, 6});
  CHECK(into.constructions[0].points[0].z == 7);
  same(into.buildings.at(0).footprint.outer[2], {5, 9});
}

TEST_CASE("streets of two sources never meet by their numbers") {
  CityFeatures into, more;
  into.streets.push_back({.where = "a", .line = {{0, 0}, {10, 0}}, .nodes = {1, INT64_MAX}});
  more.streets.push_back({.where = "b", .line = {{0, 0}, {10, 0}}, .nodes = {INT64_MAX, INT64_MIN}});
  merge(into, more);
  REQUIRE(into.streets.size() == 2);
  std::set<std::int64_t> nodes;
  for (const StreetFeature& street : into.streets) nodes.insert(street.nodes.begin(), street.nodes.end());
  CHECK(nodes.size() == 4);
}

TEST_CASE("a source on another continent is left out and told") {
  CityFeatures into, more;
  into.frame = LocalFrame({48, 11, 0});
  into.attribution = std::string("the first");
  more.frame = LocalFrame({-33, 151, 0});
  more.attribution = std::string("the second");
  more.trees.resize(3);
  merge(into, more);
  CHECK(into.trees.empty());
  CHECK(made::listed(into, "another source", "3 features"));
  CHECK(into.attribution == "the first; the second");
}
