// Real files: what the manifest of the data says of them, counted again from the JSON where that is easy.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>

#include "tests/import/cityjson/made.h"
#include "tests/support/data.h"

using namespace manzana;
using made::Json;

namespace {

struct Expected {
  const char* file;
  const char* system;
  std::size_t constructions, trees;
  GeoPoint low, high;  ///< of the manifest
};

struct Extent {
  GeoPoint low{90, 180, 0}, high{-90, -180, 0};
  void add(const LocalFrame& frame, const Vec2d& p) {
    const GeoPoint at = frame.to_geo({p, frame.ground_z(p)});
    low = {std::min(low.lat_deg, at.lat_deg), std::min(low.lon_deg, at.lon_deg), 0};
    high = {std::max(high.lat_deg, at.lat_deg), std::max(high.lon_deg, at.lon_deg), 0};
  }
};

Extent extent_of(const CityFeatures& city) {
  Extent extent;
  for (const ConstructionFeature& work : city.constructions)
    for (const Vec3d& p : work.points) extent.add(city.frame, Vec2d(p));
  for (const TreeFeature& tree : city.trees) extent.add(city.frame, tree.position);
  for (const AreaFeature& area : city.areas)
    for (const Vec2d& p : area.shape.outer) extent.add(city.frame, p);
  return extent;
}

}  // namespace

TEST_CASE("real files hold what the manifest says") {
  const auto expected = GENERATE(
      Expected{"citymodel/delft-bgt.city.json", "", 217, 0, {52.0107, 4.3620, 0}, {52.0137, 4.3696, 0}},
      Expected{"citymodel/nl-topo3d.city.json", "", 26, 0, {51.7566, 5.9650, 0}, {51.8038, 5.9902, 0}},
      Expected{
          "citymodel/berlin-lichtenberg-trees.city.json", "", 0, 288, {52.5149, 13.4792, 0}, {52.5167, 13.4821, 0}},
      Expected{"citymodel/rotterdam-textured/rotterdam_subset.json",
               "EPSG:28992",
               16,
               0,
               {51.9053, 4.4493, 0},
               {51.9092, 4.4571, 0}});
  CAPTURE(expected.file);
  const auto file = data_file(expected.file);
  if (!file) return;
  ImportOptions options;
  options.reference_system = expected.system;
  const CityFeatures city = read_cityjson(*file, options, {});
  CHECK(city.constructions.size() == expected.constructions);
  CHECK(city.trees.size() == expected.trees);
  const Extent extent = extent_of(city);
  // The manifest has two corners of the extent, turned into degrees: north of a projection is not that of the globe.
  constexpr double kConvergence = 6e-4;
  CHECK(extent.low.lat_deg == Approx(expected.low.lat_deg).margin(kConvergence));
  CHECK(extent.low.lon_deg == Approx(expected.low.lon_deg).margin(kConvergence));
  CHECK(extent.high.lat_deg == Approx(expected.high.lat_deg).margin(kConvergence));
  CHECK(extent.high.lon_deg == Approx(expected.high.lon_deg).margin(kConvergence));
}

TEST_CASE("every face of a file is there and every building stands on the ground") {
  const auto file = data_file("citymodel/delft-bgt.city.json");
  if (!file) return;
  const Json json = Json::parse(std::ifstream(*file));
  std::size_t faces = 0;
  for (const auto& [id, object] : json["CityObjects"].items())
    if (object["type"] == "Building") faces += object["geometry"][0]["boundaries"][0].size();
  const CityFeatures city = read_cityjson(*file, {}, {});
  std::size_t read = 0, buildings = 0;
  for (const ConstructionFeature& work : city.constructions) {
    double low = 1e300;
    for (const Vec3d& p : work.points) low = std::min(low, p.z);
    CHECK(low == 0);
    if (!work.where.starts_with("Building ")) continue;
    ++buildings;
    read += work.faces.size();
  }
  CHECK(buildings == 160);
  CHECK(read == faces);
}

TEST_CASE("ground of every kind covers what its surfaces cover") {
  const auto file = data_file("citymodel/delft-bgt.city.json");
  if (!file) return;
  const CityFeatures city = read_cityjson(*file, {}, {});
  std::map<std::string, std::size_t> of_type;
  for (const AreaFeature& area : city.areas) ++of_type[area.where.substr(0, area.where.find(' '))];
  for (const char* type : {"LandUse", "PlantCover", "Road", "WaterBody"}) CHECK(of_type[type] > 0);
  CHECK(of_type["Building"] == 0);
}

TEST_CASE("trees of CityJSON and of GeoJSON are the same trees") {
  const auto file = data_file("citymodel/berlin-lichtenberg-trees.city.json");
  const auto list = data_file("treelist/berlin-lichtenberg-trees.geojson");
  if (!file || !list) return;
  CityFeatures model = read_cityjson(*file, {}, {});
  const CityFeatures listed = read_tree_list(*list, {.height = "h_tree", .crown = "d_crown"}, {});
  REQUIRE(model.trees.size() == listed.trees.size());
  CityFeatures both = listed;
  both.trees.clear();
  merge(both, model);
  for (std::size_t i = 0; i < listed.trees.size(); ++i) {
    double nearest = 1e300;
    for (const TreeFeature& tree : both.trees)
      if (std::abs(tree.height - listed.trees[i].height) < 0.01 &&
          std::abs(tree.crown_radius - listed.trees[i].crown_radius) < 0.01)
        nearest = std::min(nearest, glm::distance(tree.position, listed.trees[i].position));
    CAPTURE(i, listed.trees[i].height);
    CHECK(nearest < 1.0);  // the template's crown need not be centred on the trunk
  }
}

TEST_CASE("small files with parts and levels and materials and templates") {
  const auto at = [](const char* name) { return data_file(std::string("tiny/") + name); };
  const auto bag = at("small.city.jsonl"), hague = at("denhaag-subset.city.json"), lods = at("multi-lod.city.json"),
             juniper = at("geom-template.city.jsonl");
  if (!bag || !hague || !lods || !juniper) return;
  CHECK(read_cityjson(*bag, {}, {}).constructions.size() == 3);
  CHECK(read_cityjson(*bag, {}, {}).issues.empty());
  CHECK(read_cityjson(*bag, {}, {}).attribution == "3DBAG, 3DBAG Team");

  const CityFeatures parts = read_cityjson(*hague, {}, {});
  CHECK(parts.constructions.size() == 4);
  std::size_t red = 0;
  for (const ConstructionFeature& work : parts.constructions)
    for (const auto& face : work.faces) red += face.kind == Material::roof && face.rgb == 0x800000 ? 1 : 0;
  CHECK(red > 0);

  std::size_t coarse = 0, fine = 0;
  for (const auto& work : read_cityjson(*lods, {.lod = 1.2}, {}).constructions) coarse += work.faces.size();
  for (const auto& work : read_cityjson(*lods, {}, {}).constructions) fine += work.faces.size();
  CHECK(coarse < fine);

  const CityFeatures templates = read_cityjson(*juniper, {}, {});
  CHECK(templates.trees.size() == 15);
  CHECK(templates.constructions.size() == 2);
  CHECK(made::listed(templates, "appearance", "3 of 3 pictures"));
}

TEST_CASE("a scene of CityJSON goes the whole way into blocks and the tree") {
  const auto file = data_file("citymodel/delft-bgt.city.json");
  if (!file) return;
  const Imported city = import_city(file->string(), {}, {});
  CHECK(city.scene.buildings.table.size() == 217);
  CHECK(city.report.blocks > 10);
  CHECK(city.scene.bounds.max.z < 25);
  CHECK(city.scene.bounds.min.z > -2);
}
