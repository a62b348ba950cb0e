// Every broken file ends with features and issues, or with one line; soon, and in little memory.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <set>
#include <string>

#include "scenegraph/import/import.h"
#include "tests/import/osm/written.h"
#include "tests/support/data.h"

using namespace manzana;

namespace {

constexpr double kSecondsAllowed = 5;
constexpr long kKilobytesAllowed = 500 * 1024;

/// The file's features; or, in `error`, the line that it was refused with.
CityFeatures read_broken(const std::filesystem::path& file, std::string& error) {
  const auto start = std::chrono::steady_clock::now();
  CityFeatures city;
  try {
    city = read_osm(file, {});
  } catch (const std::runtime_error& e) {
    error = e.what();
  }
  CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < kSecondsAllowed);
  return city;
}

struct Expected {
  const char* file;
  const char* error;  ///< part of the line; null: read
  std::size_t buildings, streets, trees;
  const char* where;  ///< of an issue; null: none is listed
  const char* what;
};

}  // namespace

TEST_CASE("broken files end as they should") {
  // clang-format off
  const auto expected = GENERATE(
      Expected{"antimeridian-block.osm", nullptr, 10, 18, 15, nullptr, nullptr},
      Expected{"bad-coordinates.osm", nullptr, 0, 0, 1, "node 4, line 6", "not on the Earth"},
      Expected{"corrupt-blob.osm.pbf", "data error", 0, 0, 0, nullptr, nullptr},
      Expected{"cut-in-half.osm", "line 1516, column 5", 0, 0, 0, nullptr, nullptr},
      Expected{"duplicate-and-huge-ids.osm", nullptr, 0, 0, 4, "line 8", "64 bits"},
      Expected{"empty.osm", nullptr, 0, 0, 0, "file", "nothing"},
      Expected{"empty.osm.pbf", "empty", 0, 0, 0, nullptr, nullptr},
      Expected{"entity-bomb.osm", "entity", 0, 0, 0, nullptr, nullptr},
      Expected{"header-length-huge.osm.pbf", "BlobHeader size", 0, 0, 0, nullptr, nullptr},
      Expected{"invalid-utf8.osm", "line 3, column 96", 0, 0, 0, nullptr, nullptr},
      Expected{"missing-nodes.osm", nullptr, 10, 12, 15, "way 34079465 (building)", "2 nodes are not in the file"},
      Expected{"multipolygon-broken.osm", nullptr, 1, 0, 0, "relation 104 (building)", "no outer ring"},
      Expected{"odd-heights.osm", nullptr, 14, 0, 0, "way 1006 (building)", "height 'tall'"},
      Expected{"osm2world-sameCoordNodes.osm", nullptr, 0, 0, 0, "file", "nothing"},
      Expected{"osm2world-self_intersection.osm", nullptr, 1, 0, 0, nullptr, nullptr},
      Expected{"polar-block.osm", nullptr, 10, 18, 15, nullptr, nullptr},
      Expected{"raw-size-lie.osm.pbf", "illegal blob size", 0, 0, 0, nullptr, nullptr},
      Expected{"self-intersecting-building.osm", nullptr, 1, 0, 0, nullptr, nullptr},
      Expected{"truncated.osm.pbf", "unexpected EOF", 0, 0, 0, nullptr, nullptr},
      Expected{"unclosed-building.osm", nullptr, 1, 0, 0, "way 10 (building)", "not closed"},
      Expected{"zero-area-building.osm", nullptr, 0, 0, 0, "way 10 (building)", "no area"});
  // clang-format on
  CAPTURE(expected.file);
  const auto file = data_file(std::string("broken/osm/") + expected.file);
  if (!file) return;
  std::string error;
  const CityFeatures city = read_broken(*file, error);
  CAPTURE(error);
  REQUIRE(error.empty() == (expected.error == nullptr));
  if (expected.error != nullptr) {
    CHECK(error.starts_with(file->string() + ": "));
    CHECK(error.find(expected.error) != std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
    return;
  }
  CHECK(city.buildings.size() == expected.buildings);
  CHECK(city.streets.size() == expected.streets);
  CHECK(city.trees.size() == expected.trees);
  CHECK(city.issues.empty() == (expected.where == nullptr));
  if (expected.where != nullptr) CHECK(written::listed(city, expected.where, expected.what));
}

TEST_CASE("no file of the broken folder is forgotten, and all take little memory") {
  const auto folder = data_file("broken/osm");
  if (!folder) return;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    CAPTURE(entry.path());
    std::string error;
    const CityFeatures city = read_broken(entry.path(), error);
    const bool said = !error.empty() || !city.issues.empty() || !city.buildings.empty();
    CHECK(said);
    ++files;
  }
  CHECK(files == 21);
#ifdef NDEBUG  // sanitizers and debugging have their own price
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  CHECK(usage.ru_maxrss < kKilobytesAllowed);
#endif
}

TEST_CASE("odd heights, one by one") {
  const auto file = data_file("broken/osm/odd-heights.osm");
  if (!file) return;
  const CityFeatures city = read_osm(*file, {});
  REQUIRE(city.buildings.size() == 14);
  struct Row {
    std::size_t building;
    double height;  ///< metres; 0: refused, so the rule's
  };
  // "12,5" "40 ft" "40'6\"" "1e9" "-5" "NaN" "tall" "" "0" "12 m" "12;15" "  9  " "1e-12" "99999999999999999999"
  const auto row = GENERATE(Row{0, 12.5}, Row{1, 12.192}, Row{2, 12.3444}, Row{3, 0}, Row{4, 0}, Row{5, 0}, Row{6, 0},
                            Row{7, 0}, Row{8, 0}, Row{9, 12}, Row{10, 0}, Row{11, 9}, Row{12, 0}, Row{13, 0});
  CAPTURE(row.building);
  const BuildingFeature& building = city.buildings[row.building];
  const std::string where = "way " + std::to_string(1000 + row.building) + " (building)";
  CHECK(building.where == where);
  CHECK(written::listed(city, where, "height '") == (row.height == 0));
  if (row.height != 0) CHECK(building.height == Approx(row.height));
  if (row.height == 0) CHECK((building.height > 2 && building.height < 60));
  CHECK(building.levels >= 1);
  CHECK(building.levels <= 20);
  CHECK(building.min_height == 0);
  CHECK(building.roof_height <= building.height);
}

TEST_CASE("levels that are odd, one by one") {
  const auto file = data_file("broken/osm/odd-heights.osm");
  if (!file) return;
  const CityFeatures city = read_osm(*file, {});
  const std::set<std::size_t> usable{1, 2, 5, 13};  // "1e-12", "  9  ", "0", "12,5"
  for (std::size_t i = 0; i < 14; ++i) {
    const std::string where = "way " + std::to_string(1000 + i) + " (building)";
    CAPTURE(where);
    CHECK(written::listed(city, where, "building:levels '") == !usable.contains(i));
  }
  REQUIRE(city.buildings.size() == 14);
  CHECK(city.buildings[2].levels == 6);                  // nine told, but 12.34 m hold six with windows
  CHECK(city.buildings[13].height >= 0.5 + 12.5 * 3.0);  // the height was refused, the levels count
  CHECK(city.buildings[13].levels == 13);
}

TEST_CASE("files that are no OpenStreetMap files are refused by name") {
  for (const char* name : {"no-such-file.osm", "/", "http://example.org/x.osm", "", "\n.osm"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(read_osm(name, {}), std::runtime_error);
  }
  CHECK_THROWS_WITH(read_osm_bytes("<html><osm/></html>", "osm", "x"), Catch::Contains("x: not an OpenStreetMap file"));
  CHECK_THROWS_WITH(read_osm_bytes("<osm>\n<node id='1'\n</osm>", "osm", "x"), Catch::Contains("line 3"));
}
