// GeoPackages, read back by SQLite, and by GDAL where its tools are installed.
#include "scenegraph/export/geopackage.h"

#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "scenegraph/export/tile_content.h"
#include "scenegraph/import/import.h"
#include "tests/support/data.h"
#include "tests/support/program.h"

namespace {

using namespace manzana;
using Path = std::filesystem::path;

/// Reads with SQLite alone.
class Package {
 public:
  explicit Package(const Path& file) {
    REQUIRE(sqlite3_open_v2(file.c_str(), &db_, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK);
  }
  ~Package() { sqlite3_close(db_); }
  Package(const Package&) = delete;
  Package& operator=(const Package&) = delete;

  std::vector<std::vector<std::string>> rows(const std::string& sql) const {
    std::vector<std::vector<std::string>> all;
    sqlite3_stmt* statement = nullptr;
    INFO(sql);
    REQUIRE(sqlite3_prepare_v2(db_, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK);
    while (sqlite3_step(statement) == SQLITE_ROW) {
      auto& row = all.emplace_back();
      for (int i = 0; i < sqlite3_column_count(statement); ++i) {
        const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement, i));
        row.emplace_back(bytes == nullptr ? "" : bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement, i)));
      }
    }
    sqlite3_finalize(statement);
    return all;
  }
  std::string text(const std::string& sql) const { return rows(sql).at(0).at(0); }
  double number(const std::string& sql) const { return std::stod(text(sql)); }

 private:
  sqlite3* db_ = nullptr;
};

template <class T>
T at(const std::string& blob, std::size_t offset) {
  T value;
  REQUIRE(offset + sizeof value <= blob.size());
  std::memcpy(&value, blob.data() + offset, sizeof value);
  return value;
}

constexpr std::size_t kWkb = 8 + 32;  // behind the header and its envelope

/// Degrees; of the outer rings of a multipolygon less those of the holes, in plan metres of a frame.
double area_of(const std::string& blob, const LocalFrame& frame) {
  double area = 0;
  std::size_t offset = kWkb + 5;
  const auto polygons = at<std::uint32_t>(blob, offset);
  offset += 4;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    const auto rings = at<std::uint32_t>(blob, offset + 5);
    offset += 9;
    for (std::uint32_t r = 0; r < rings; ++r) {
      const auto points = at<std::uint32_t>(blob, offset);
      offset += 4;
      std::vector<Vec2d> ring;
      for (std::uint32_t i = 0; i < points; ++i, offset += 16)
        ring.emplace_back(frame.to_local({at<double>(blob, offset + 8), at<double>(blob, offset), 0}));
      CHECK(ring.front() == ring.back());
      double twice = 0;
      for (std::size_t i = 1; i < ring.size(); ++i) twice += ring[i - 1].x * ring[i].y - ring[i].x * ring[i - 1].y;
      area += (r == 0 ? 0.5 : -0.5) * std::abs(twice);
    }
  }
  CHECK(offset == blob.size());
  return area;
}

/// A street with a house of 20 m x 10 m with a yard of 4 m x 4 m, and a tree.
CityFeatures made(const GeoPoint& anchor) {
  CityFeatures city;
  city.frame = LocalFrame(anchor);
  BuildingFeature house;
  house.where = "way 1";
  house.footprint = {{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{{8, 3}, {8, 7}, {12, 7}, {12, 3}}}};
  house.height = 9;
  city.buildings.push_back(house);
  city.trees.push_back({.position = {30, 5}, .height = 12, .crown_radius = 3, .species = PlantSpecies::oak});
  return city;
}

Scene scene_of(CityFeatures city) { return build_scene(std::move(city), {.cars = 0}, {}).scene; }

}  // namespace

TEST_CASE("geopackage: a house has its footprint with its yard and a tree its place") {
  const TemporaryFolder folder;
  const Path file = folder.path() / "made.gpkg";
  const CityFeatures city = made({52, 13, 0});
  const LocalFrame frame = city.frame;
  const GeopackageWritten written = write_geopackage(scene_of(city), file);
  CHECK((written.blocks >= 1 && written.buildings == 1 && written.trees == 1));
  const Package package(file);
  CHECK(package.text("PRAGMA integrity_check") == "ok");
  CHECK(package.number("SELECT height FROM buildings") == Approx(9).margin(1e-3));
  CHECK(area_of(package.text("SELECT geom FROM buildings"), frame) == Approx(20 * 10 - 4 * 4).epsilon(1e-4));
  const auto tree = package.rows("SELECT species, height, crown, geom FROM trees").at(0);
  CHECK(tree.at(0) == "oak");
  CHECK(std::stod(tree.at(1)) == Approx(12));
  CHECK(std::stod(tree.at(2)) == Approx(6));
  const Vec3d place = frame.to_local({at<double>(tree.at(3), kWkb + 13), at<double>(tree.at(3), kWkb + 5), 0});
  CHECK(glm::distance(Vec2d(place), Vec2d(30, 5)) < 1e-3);
}

TEST_CASE("geopackage: the tables say where all is and how to find it") {
  const TemporaryFolder folder;
  const Path file = folder.path() / "village.gpkg";
  const Imported city = import_city(MANZANA_VILLAGE, {.cars = 0}, {});
  const GeopackageWritten written = write_geopackage(city.scene, file);
  CHECK(written.buildings == city.scene.buildings.table.size());
  CHECK(written.trees == city.scene.trees.table.size());
  CHECK(read_all(file).substr(68, 4) == "GPKG");
  const Package package(file);
  const std::map<std::string, std::size_t> layers{
      {"blocks", written.blocks}, {"buildings", written.buildings}, {"trees", written.trees}};
  for (const auto& [layer, count] : layers) {
    CAPTURE(layer);
    const auto of = [&](const std::string& sql) { return package.number(sql + " WHERE table_name = '" + layer + "'"); };
    CHECK(package.number("SELECT count(*) FROM " + layer) == static_cast<double>(count));
    CHECK(package.number("SELECT count(*) FROM rtree_" + layer + "_geom") == static_cast<double>(count));
    CHECK(of("SELECT srs_id FROM gpkg_contents") == 4326);
    CHECK(of("SELECT srs_id FROM gpkg_geometry_columns") == 4326);
    CHECK(of("SELECT count(*) FROM gpkg_extensions") == 1);
    CHECK(of("SELECT min_x FROM gpkg_contents") ==
          Approx(package.number("SELECT min(minx) FROM rtree_" + layer + "_geom")).margin(1e-4));
    const GeoPoint anchor = city.scene.frame.anchor();
    CHECK(std::abs(of("SELECT max_y FROM gpkg_contents") - anchor.lat_deg) < 0.02);
    CHECK(std::abs(of("SELECT max_x FROM gpkg_contents") - anchor.lon_deg) < 0.03);
  }
  CHECK(package.number("SELECT sum(buildings) FROM blocks") == static_cast<double>(written.buildings));
}

TEST_CASE("geopackage: a city on the antimeridian stays in one piece") {
  const TemporaryFolder folder;
  const Path file = folder.path() / "made.gpkg";
  write_geopackage(scene_of(made({-17, 179.9999, 0})), file);  // 20 m are 0.0002 degrees
  const Package package(file);
  CHECK(package.number("SELECT max(max_x) - min(min_x) FROM gpkg_contents") < 0.001);
}

TEST_CASE("geopackage: a file is replaced whole or left as it was") {
  const TemporaryFolder folder;
  const Path file = folder.path() / "made.gpkg";
  std::ofstream(file) << "what was there";
  const Scene scene = scene_of(made({52, 13, 0}));
  const auto stop = [](std::string_view, double) { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(write_geopackage(scene, file, stop), Catch::EndsWith("made.gpkg: enough"));
  CHECK(read_all(file) == "what was there");
  CHECK(files_in(folder.path()) == 1);
  write_geopackage(scene, file);
  CHECK(Package(file).number("SELECT count(*) FROM trees") == 1);
  CHECK(files_in(folder.path()) == 1);
  CHECK_THROWS_WITH(write_geopackage(scene, folder.path() / "no" / "made.gpkg"),
                    Catch::Contains("made.gpkg: cannot be written"));
}

TEST_CASE("geopackage: buildings and trees have the ids of their file") {
  const auto real = data_file("tiny/helsinki-block.osm");
  if (!real) return;
  const TemporaryFolder folder;
  const Path file = folder.path() / "block.gpkg";
  const Scene scene = import_city(*real, {.cars = 0, .attributes = true}, {}).scene;
  write_geopackage(scene, file);
  const Package package(file);
  std::multiset<std::string> expected, found;
  for (std::uint32_t row = 0; row < scene.buildings.table.size(); ++row)
    expected.insert(source_of(scene, scene.buildings.table, row));
  for (const auto& row : package.rows("SELECT source_id FROM buildings")) found.insert(row.at(0));
  CHECK(found.size() > 5);
  CHECK(std::ranges::includes(expected, found));  // but for those without a footprint
  CHECK(package.number("SELECT count(*) FROM buildings WHERE source_id LIKE 'way/%' OR source_id LIKE 'relation/%'") ==
        static_cast<double>(found.size()));
  const Path without = folder.path() / "without.gpkg";
  write_geopackage(import_city(*real, {.cars = 0}, {}).scene, without);
  CHECK(Package(without).number("SELECT count(*) FROM buildings WHERE source_id <> ''") == 0);
}

#ifdef MANZANA_OGRINFO
TEST_CASE("geopackage: GDAL reads every layer and finds every footprint valid") {
  const auto real = data_file("osm/helsinki-centre.osm.pbf");
  if (!real) return;
  const TemporaryFolder folder;
  const Path file = folder.path() / "helsinki.gpkg";
  const GeopackageWritten written = write_geopackage(import_city(*real, {.cars = 0}, {}).scene, file);
  const auto ask = [&](const std::string& sql) {
    return run_program(MANZANA_OGRINFO, folder.path(), {file, "-q", "-dialect", "sqlite", "-sql", sql}).out;
  };
  for (const char* layer : {"blocks", "buildings"})
    CHECK_THAT(ask(std::string("SELECT min(ST_IsValid(geom)) AS valid FROM ") + layer),
               Catch::Contains("valid (Integer) = 1"));
  CHECK_THAT(ask("SELECT count(*) AS trees FROM trees"), Catch::Contains("= " + std::to_string(written.trees)));
  CHECK_THAT(run_program(MANZANA_OGRINFO, folder.path(), {"-so", file, "blocks"}).out,
             Catch::Contains("ID[\"EPSG\",4326]") && Catch::Contains("Extent: (24.9"));
}
#endif
