// Terrain from files, by GDAL.
#include <cmath>

#include "scenegraph/import/gis_vectors.h"
#include "scenegraph/import/terrain.h"
#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace manzana;
using Path = std::filesystem::path;

constexpr int kSide = 1201;  // SRTM: samples a degree and one

double made_height(double lat, double lon) { return 300 + 900 * (lat - 49) + 400 * (lon - 11); }

/// Of the square degree at 49 north, 11 east: a slope, with a hole.
Path made_hgt(const TemporaryFolder& folder, bool all_void = false) {
  std::string bytes;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double lat = 50 - row / 1200.0, lon = 11 + column / 1200.0;
      const bool hole = all_void || (std::abs(lat - 49.503) < 0.002 && std::abs(lon - 11.503) < 0.002);
      const int h = hole ? -32768 : static_cast<int>(std::lround(made_height(lat, lon)));
      bytes.push_back(static_cast<char>(h >> 8 & 255));
      bytes.push_back(static_cast<char>(h & 255));
    }
  std::ofstream(folder.path() / "N49E011.hgt", std::ios::binary) << bytes;
  return folder.path() / "N49E011.hgt";
}

CityFeatures trees_about(double lat, double lon) {
  CityFeatures city;
  city.frame = LocalFrame({lat, lon, 0});
  city.trees.push_back({.position = {-1500, -1000}});
  city.trees.push_back({.position = {1500, 1000}});
  return city;
}

}  // namespace

TEST_CASE("read terrain: SRTM heights come where they belong and voids are filled") {
  const TemporaryFolder folder;
  const CityFeatures city = trees_about(49.5, 11.5);
  const Terrain terrain = read_terrain(made_hgt(folder), city);
  CHECK(terrain.step == Approx(60).margin(5));  // a pixel is 60 m wide there
  CHECK(terrain.end().x > 1800);
  double worst = 0;
  for (double x = -1800; x <= 1800; x += 77)
    for (double y = -1300; y <= 1300; y += 77) {
      const GeoPoint place = city.frame.to_geo({x, y, city.frame.ground_z({x, y})});
      worst =
          std::max(worst, std::abs(terrain.at({x, y}) + terrain.base_m - made_height(place.lat_deg, place.lon_deg)));
    }
  CHECK(worst < 2.5);  // whole metres; a mean over the hole of some 400 m
  CHECK(*std::min_element(terrain.heights.begin(), terrain.heights.end()) == 0);
}

TEST_CASE("read terrain: a file that does not reach the city or holds no heights is told") {
  const TemporaryFolder folder;
  const Path file = made_hgt(folder);
  CHECK_THROWS_WITH(read_terrain(file, trees_about(52, 13)), Catch::StartsWith(file.string() + ": "));
  CHECK_THROWS_WITH(read_terrain(folder.path() / "none.tif", trees_about(49.5, 11.5)), Catch::EndsWith("no such file"));
  std::ofstream(folder.path() / "a.tif") << "II*";
  CHECK_THROWS_WITH(read_terrain(folder.path() / "a.tif", trees_about(49.5, 11.5)), Catch::Contains("cannot be read"));
  CHECK(read_terrain(file, CityFeatures()).level());
  CHECK_THROWS_WITH(read_terrain(made_hgt(folder, true), trees_about(49.5, 11.5)),
                    Catch::EndsWith("has no heights where the city is"));
}

TEST_CASE("read terrain: Bayreuth stands on its hills") {
  const auto osm = data_file("osm/north-bayreuth.osm.gz"), hgt = data_file("terrain/N49E011.hgt.zip");
  if (!osm || !hgt) return;
  const CityFeatures city = read_city(*osm, {}, {});
  const Terrain terrain = read_terrain(*hgt, city);
  CHECK(terrain.base_m > 230);
  CHECK(*std::max_element(terrain.heights.begin(), terrain.heights.end()) < 700);
  CHECK(terrain.at({0, 0}) + terrain.base_m > 300);
  CHECK(terrain.at({0, 0}) + terrain.base_m < 600);
}
