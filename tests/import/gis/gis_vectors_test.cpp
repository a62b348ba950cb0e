// Footprints and tree points by GDAL.
#include "scenegraph/import/gis_vectors.h"

#include <algorithm>

#include "scenegraph/export/geopackage.h"
#include "tests/support/data.h"
#include "tests/support/program.h"

namespace {

using namespace manzana;
using Path = std::filesystem::path;

Path written(const TemporaryFolder& folder, const char* name, const std::string& text) {
  std::ofstream(folder.path() / name, std::ios::binary) << text;
  return folder.path() / name;
}

/// A house with a yard, one of three storeys in two parts, a street, a tree, and a feature without geometry.
constexpr const char* kTown = R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": {"id": "A1", "height": 14.5}, "geometry": {"type": "Polygon", "coordinates":
    [[[13, 52], [13.001, 52], [13.001, 52.001], [13, 52.001], [13, 52]],
     [[13.0004, 52.0004], [13.0004, 52.0006], [13.0006, 52.0006], [13.0006, 52.0004], [13.0004, 52.0004]]]}},
  {"type": "Feature", "properties": {"id": "A2", "levels": 3}, "geometry": {"type": "MultiPolygon", "coordinates":
    [[[[13.002, 52], [13.0022, 52], [13.0022, 52.0001], [13.002, 52]]],
     [[[13.003, 52], [13.0032, 52], [13.0032, 52.0001], [13.003, 52]]]]}},
  {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[13, 52], [13.1, 52]]}},
  {"type": "Feature", "properties": {"species": "Quercus robur", "height": 17, "crown": 8},
   "geometry": {"type": "Point", "coordinates": [13.0005, 52.002]}},
  {"type": "Feature", "properties": {"id": "A9"}, "geometry": null}]})";

double area(const std::vector<Vec2d>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

void check_town(const CityFeatures& city) {
  REQUIRE(city.buildings.size() == 3);
  const BuildingFeature& house = city.buildings[0];
  CHECK(house.height == 14.5);
  CHECK(house.levels == 5);
  REQUIRE(house.footprint.holes.size() == 1);
  CHECK(area(house.footprint.outer) == Approx(68.67 * 111.27).epsilon(0.002));  // thousandths of a degree at 52 north
  CHECK(area(house.footprint.holes[0]) == Approx(area(house.footprint.outer) / 25).epsilon(0.001));
  CHECK(city.buildings[1].levels == 3);
  CHECK(city.buildings[1].height > 9);
  REQUIRE(city.trees.size() == 1);
  CHECK(city.trees[0].species == PlantSpecies::oak);
  CHECK(city.trees[0].height == 17);
  CHECK(city.trees[0].crown_radius == 4);
}

}  // namespace

TEST_CASE("gis vectors: properties are kept where they are asked for") {
  const TemporaryFolder folder;
  const Path file = written(folder, "town.geojson", kTown);
  const CityFeatures city = read_gis_vectors(file, {}, {.attributes = true});
  REQUIRE(city.buildings.size() == 3);
  REQUIRE(city.trees.size() == 1);
  const auto row = [&](std::uint32_t i) { return city.attributes.table().row(i); };
  CHECK(row(city.buildings[0].attributes).find("id") == "A1");
  CHECK(row(city.buildings[0].attributes).source() == "A1");
  CHECK(row(city.trees[0].attributes).source().starts_with("town/"));  // it has none: its row
  CHECK(row(city.buildings[0].attributes).number("height") == 14.5);
  CHECK_FALSE(row(city.buildings[0].attributes).find("levels"));
  CHECK(city.buildings[1].attributes == city.buildings[2].attributes);
  CHECK(row(city.trees[0].attributes).find("species") == "Quercus robur");
  CHECK(read_gis_vectors(file, {}, {}).buildings[0].attributes == 0);
}

TEST_CASE("gis vectors: GeoJSON brings footprints and trees and lists the rest") {
  const TemporaryFolder folder;
  const CityFeatures city = read_gis_vectors(written(folder, "town.geojson", kTown), {}, {});
  check_town(city);
  CHECK(city.buildings[0].where == "town A1");
  REQUIRE(city.issues.size() == 2);
  CHECK(city.issues[0].what == "has no geometry");
  CHECK(city.issues[1].what == "1 geometries that are neither polygon nor point");
  const GeoPoint corner = city.frame.to_geo(Vec3d(city.buildings[0].footprint.outer[0], 0));
  CHECK(corner.lat_deg == Approx(52).margin(1e-7));
  CHECK(corner.lon_deg == Approx(13).margin(1e-7));
}

#ifdef MANZANA_OGR2OGR
TEST_CASE("gis vectors: a Shapefile in a projected system is the same town") {
  const TemporaryFolder folder;
  const Path source = written(folder, "town.geojson", kTown), shape = folder.path() / "houses.shp";
  const Ended ended = run_program(
      MANZANA_OGR2OGR, folder.path(),
      {"-t_srs", "EPSG:25833", "-nlt", "PROMOTE_TO_MULTI", "-where", "OGR_GEOMETRY LIKE '%POLYGON'", shape, source});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const CityFeatures houses = read_gis_vectors(shape, {}, {}), town = read_gis_vectors(source, {}, {});
  REQUIRE(houses.buildings.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2d at = houses.buildings[i].footprint.outer[0];
    double nearest = 1e9;
    for (const Vec2d& p : town.buildings[i].footprint.outer)
      nearest = std::min(
          nearest,
          glm::distance(Vec2d(town.frame.to_local(houses.frame.to_geo({at.x, at.y, houses.frame.ground_z(at)}))), p));
    CHECK(nearest < 0.01);
  }
}
#endif

TEST_CASE("gis vectors: what we write to a GeoPackage comes back") {
  const TemporaryFolder folder;
  const Imported village = import_city(MANZANA_VILLAGE, {.cars = 0}, {});
  write_geopackage(village.scene, folder.path() / "village.gpkg");
  const CityFeatures back = read_city(folder.path() / "village.gpkg", {}, {});
  CHECK(back.trees.size() == village.scene.trees.table.size());
  CHECK(back.buildings.size() >= village.scene.buildings.table.size());
  std::vector<std::pair<float, int>> before, after;
  for (const TreeInstance& tree : village.scene.trees.instances) before.emplace_back(tree.height_m, tree.plant);
  for (const TreeFeature& tree : back.trees)
    after.emplace_back(static_cast<float>(tree.height), static_cast<int>(*tree.species));
  std::ranges::sort(before);
  std::ranges::sort(after);
  CHECK(before == after);
  const Imported again = build_scene(back, {.cars = 0}, {});
  CHECK(again.scene.buildings.table.size() >= village.scene.buildings.table.size());
}

TEST_CASE("gis vectors: trees of Berlin are where the reader of lists has them") {
  const auto file = data_file("treelist/berlin-lichtenberg-trees.geojson");
  if (!file) return;
  const TreeColumns columns{.height = "h_tree", .crown = "d_crown"};
  const CityFeatures one = read_gis_vectors(*file, columns, {}), other = read_tree_list(*file, columns, {});
  REQUIRE(one.trees.size() == other.trees.size());
  for (std::size_t i = 0; i < one.trees.size(); ++i) {
    const Vec2d p = one.trees[i].position;
    const GeoPoint place = one.frame.to_geo({p.x, p.y, one.frame.ground_z(p)});
    CHECK(glm::distance(Vec2d(other.frame.to_local({place.lat_deg, place.lon_deg, 0})), other.trees[i].position) <
          0.01);
    CHECK(one.trees[i].height == other.trees[i].height);
    CHECK(one.trees[i].crown_radius == other.trees[i].crown_radius);
  }
}

TEST_CASE("gis vectors: what cannot be read is told in one line with the file's name") {
  const TemporaryFolder folder;
  for (const char* name : {"a.gpkg", "a.shp", "a.geojson"})
    for (const char* text : {"", "SQLite format 3", "{\"type\": \"FeatureCollection\"", "<xml/>"}) {
      const Path file = written(folder, name, text);
      CAPTURE(name, text);
      CHECK_THROWS_WITH(read_gis_vectors(file, {}, {}), Catch::StartsWith(file.string() + ": cannot be read"));
    }
  CHECK_THROWS_WITH(read_gis_vectors(folder.path() / "none.gpkg", {}, {}), Catch::EndsWith("none.gpkg: no such file"));
}
