// What is read, by small files made for it.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/import/cityjson/made.h"
#include "tests/support/random.h"

using namespace manzana;
using made::Json;

namespace {

double lowest(const ConstructionFeature& work) {
  double z = 1e300;
  for (const Vec3d& p : work.points) z = std::min(z, p.z);
  return z;
}
double highest(const ConstructionFeature& work) {
  double z = -1e300;
  for (const Vec3d& p : work.points) z = std::max(z, p.z);
  return z;
}

/// A ring of terrain 200 m wide, `height` at the west edge rising to `height` + 20 at the east.
void add_terrain(Json& json, double height) {
  const auto first = static_cast<int>(json["vertices"].size());
  for (const auto& p : {std::array{-95.0, -96.0, 0.0}, {105.0, -96.0, 20.0}, {105.0, 104.0, 20.0}, {-95.0, 104.0, 0.0}})
    json["vertices"].push_back({691000 + p[0], 5334000 + p[1], height + p[2]});
  json["CityObjects"]["tin"] = {
      {"type", "TINRelief"},
      {"geometry",
       {{{"type", "CompositeSurface"},
         {"lod", "1"},
         {"boundaries", {{{first, first + 1, first + 2}}, {{first, first + 2, first + 3}}}}}}}};
}

}  // namespace

TEST_CASE("a building at 412 m stands on the ground with its lowest point") {
  const CityFeatures city = made::read(made::one_building());
  REQUIRE(city.constructions.size() == 1);
  CHECK(city.issues.empty());
  CHECK(lowest(city.constructions[0]) == 0);
  CHECK(highest(city.constructions[0]) == Approx(6));
  CHECK(city.frame.anchor().height_m == 0);
  CHECK(city.frame.anchor().lat_deg == Approx(48.1349).margin(0.01));
}

TEST_CASE("where there is a terrain its height below the middle of a building is the ground") {
  Json json = made::one_building();
  add_terrain(json, 405);  // 10 m higher at the building's middle: 415
  const CityFeatures city = made::read(json);
  REQUIRE(city.constructions.size() == 1);
  CHECK(lowest(city.constructions[0]) == Approx(-3).margin(1e-3));
  CHECK(highest(city.constructions[0]) == Approx(3).margin(1e-3));
}

TEST_CASE("parts are one construction with their building and rooms are left out") {
  Json json = made::one_building();
  for (const Json& v : made::box_vertices({691010, 5334000, 412}, {691014, 5334008, 420}))
    json["vertices"].push_back(v);
  json["CityObjects"]["part"] = {{"type", "BuildingPart"}, {"parents", {"house"}}, {"geometry", {made::solid(8)}}};
  json["CityObjects"]["room"] = {{"type", "BuildingRoom"}, {"parents", {"house"}}, {"geometry", {made::solid(8)}}};
  const CityFeatures city = made::read(json);
  REQUIRE(city.constructions.size() == 1);
  CHECK(city.constructions[0].part_last.size() == 2);
  CHECK(city.constructions[0].faces.size() == 12);
  CHECK(highest(city.constructions[0]) == Approx(8));
}

TEST_CASE("a building that leans on itself is told and read") {
  Json json = made::one_building();
  json["CityObjects"]["house"]["parents"] = {"house"};
  const CityFeatures city = made::read(json);
  CHECK(city.constructions.size() == 1);
  CHECK(made::listed(city, "house", "parents go round"));
}

TEST_CASE("the finest level of detail that is wanted is taken") {
  Json json = made::one_building();
  Json& geometry = json["CityObjects"]["house"]["geometry"];
  geometry[0]["lod"] = "2.2";
  geometry.push_back({{"type", "MultiSurface"}, {"lod", 1.2}, {"boundaries", {{{0, 2, 3, 1}}, {{4, 5, 7, 6}}}}});
  geometry.push_back({{"type", "MultiSurface"}, {"lod", "0"}, {"boundaries", {{{0, 1, 3, 2}}}}});
  const auto faces = [&](double lod) {
    const CityFeatures city = made::read(json, {.lod = lod});
    return city.constructions.empty() ? 0 : city.constructions[0].faces.size();
  };
  CHECK(faces(9) == 6);
  CHECK(faces(2.2) == 6);
  CHECK(faces(2.1) == 2);
  CHECK(faces(1) == 0);  // a footprint is not a building
}

TEST_CASE("semantics and materials give kinds and colours") {
  Json json = made::one_building();
  Json& geometry = json["CityObjects"]["house"]["geometry"][0];
  geometry["semantics"] = {{"surfaces", {{{"type", "WallSurface"}}, {{"type", "RoofSurface"}}, {{"type", "Window"}}}},
                           {"values", {{nullptr, 1, 0, 0, 0, 2}}}};
  geometry["material"] = {{"", {{"values", {{nullptr, 0, nullptr, 7, nullptr, nullptr}}}}}};
  json["appearance"]["materials"] = {{{"name", "red"}, {"diffuseColor", {1.0, 0.0, 0.5}}}};
  const CityFeatures city = made::read(json);
  REQUIRE(city.constructions.size() == 1);
  const auto& faces = city.constructions[0].faces;
  REQUIRE(faces.size() == 6);
  CHECK(faces[0].kind == Material::wall);  // no semantics, but it looks down
  CHECK(faces[1].kind == Material::roof);
  CHECK(faces[1].rgb == 0xff0080);
  CHECK(faces[3].kind == Material::wall);
  CHECK(faces[3].rgb == faces[2].rgb);  // there is no material 7
  CHECK(faces[5].kind == Material::concrete);
}

TEST_CASE("ground is flattened and joined by kind") {
  Json json = made::city();
  for (int i = 0; i <= 10; ++i)
    for (const double y : {0.0, 6.0}) json["vertices"].push_back({691000 + 10.0 * i, 5334000 + y, 400 + i});
  Json strips = Json::array();
  for (int i = 0; i < 10; ++i) strips.push_back({{2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1}});
  const Json geometry = {{{"type", "MultiSurface"}, {"lod", "1"}, {"boundaries", strips}}};
  json["CityObjects"]["road"] = {{"type", "Road"}, {"geometry", geometry}};
  json["CityObjects"]["path"] = {{"type", "Road"}, {"attributes", {{"function", {"voetpad"}}}}, {"geometry", geometry}};
  json["CityObjects"]["pond"] = {{"type", "WaterBody"}, {"geometry", geometry}};
  const CityFeatures city = made::read(json);
  REQUIRE(city.areas.size() == 3);
  for (const AreaFeature& area : city.areas) CHECK(area.shape.holes.empty());
  const auto has = [&](Material kind) { return std::ranges::count(city.areas, kind, &AreaFeature::kind) == 1; };
  CHECK(has(Material::junction));
  CHECK(has(Material::pavement));
  CHECK(has(Material::water));
}

TEST_CASE("instances of templates become trees and works of the size that the matrix says") {
  Json json = made::city();
  json["vertices"] = {{691000, 5334000, 412}, {691100, 5334000, 412}};
  json["geometry-templates"] = {{"templates", {made::solid()}},
                                {"vertices-templates", made::box_vertices({-0.5, -0.5, 0}, {0.5, 0.5, 1})}};
  const Json instance = {{"type", "GeometryInstance"},
                         {"template", 0},
                         {"boundaries", {0}},
                         {"transformationMatrix", {4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 12, 0, 0, 0, 0, 1}}};
  Json other = instance;
  other["boundaries"] = {1};
  json["CityObjects"]["tree"] = {
      {"type", "SolitaryVegetationObject"}, {"attributes", {{"species", "Quercus robur"}}}, {"geometry", {instance}}};
  json["CityObjects"]["lamp"] = {{"type", "CityFurniture"}, {"geometry", {other}}};
  const CityFeatures city = made::read(json);
  REQUIRE(city.trees.size() == 1);
  CHECK(city.trees[0].height == Approx(12));
  CHECK(city.trees[0].crown_radius == Approx(2).epsilon(1e-3));
  CHECK(city.trees[0].species == PlantSpecies::oak);
  REQUIRE(city.constructions.size() == 1);
  CHECK(highest(city.constructions[0]) == Approx(12));
  CHECK(glm::distance(city.trees[0].position, Vec2d(city.constructions[0].points[0])) == Approx(98).epsilon(0.01));
}

TEST_CASE("a stray building is told and does not draw the others aside") {
  Json json = made::one_building();
  for (const Json& v : made::box_vertices({691020, 5334000, 412}, {691030, 5334008, 418}))
    json["vertices"].push_back(v);
  for (const Json& v : made::box_vertices({400000, 9334000, 412}, {400001, 9334008, 418}))
    json["vertices"].push_back(v);
  json["CityObjects"]["neighbour"] = {{"type", "Building"}, {"geometry", {made::solid(8)}}};
  json["CityObjects"]["stray"] = {{"type", "Building"}, {"geometry", {made::solid(16)}}};
  const CityFeatures city = made::read(json);
  CHECK(city.constructions.size() == 2);
  CHECK(made::listed(city, "stray", "too far"));
  for (const ConstructionFeature& work : city.constructions) CHECK(glm::length(Vec2d(work.points[0])) < 100);
}

TEST_CASE("bytes changed at random end with features or one line") {
  Json json = made::one_building();
  add_terrain(json, 405);
  const std::string good = json.dump();
  support::Random random(20);
  int read = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = good;
    for (int k = random.below(4); k >= 0; --k) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())));
      if (random.below(3) == 0)
        bytes.erase(at, static_cast<std::size_t>(random.below(30)));
      else
        bytes[at] = "0123456789-.eE[]{},:\"ntf"[random.below(24)];
    }
    try {
      const CityFeatures city = read_cityjson_bytes(bytes, round % 2 == 1, {}, {});
      for (const ConstructionFeature& work : city.constructions)
        for (const Vec3d& p : work.points) REQUIRE(std::isfinite(p.x + p.y + p.z));
      ++read;
    } catch (const std::runtime_error& error) {
      REQUIRE(std::string(error.what()).find('\n') == std::string::npos);
    }
  }
  CHECK(read > 100);
}
