#include "scenegraph/import/tree_list.h"

#include <catch2/catch.hpp>

#include "scenegraph/import/csv_rows.h"
#include "tests/import/cityjson/made.h"
#include "tests/support/data.h"
#include "tests/support/random.h"

using namespace manzana;

namespace {
CityFeatures csv(const std::string& text, const TreeColumns& columns = {}, const ImportOptions& options = {}) {
  return read_tree_bytes(text, false, columns, options);
}
}  // namespace

TEST_CASE("rows are split as their header is") {
  CsvRows rows(
      "\xef\xbb\xbf"
      "a;b,c;d\r\n\r\n1;\"x;\"\"y\"\"\";3\n;;\n\"open;2;3\n");
  CHECK(rows.header() == std::vector<std::string>{"a", "b,c", "d"});
  CHECK(rows.column("d") == 2U);
  CHECK_FALSE(rows.column("e"));
  CsvRow row;
  REQUIRE(rows.next(row));
  CHECK(row.line == 3);
  CHECK(row.fields == std::vector<std::string>{"1", "x;\"y\"", "3"});
  REQUIRE(rows.next(row));
  CHECK(row.fields.size() == 3);
  REQUIRE(rows.next(row));
  CHECK(row.open_quote);
  CHECK_FALSE(rows.next(row));
}

TEST_CASE("columns are those that are named or those of the usual names") {
  const CityFeatures usual = csv("lat,lon,species,height,crown\n52,4,Betula pendula,12,5\n");
  REQUIRE(usual.trees.size() == 1);
  CHECK(usual.trees[0].species == PlantSpecies::birch);
  CHECK(usual.trees[0].height == 12);
  CHECK(usual.trees[0].crown_radius == 2.5);
  const CityFeatures named =
      csv("N\tE\tBaum\tH\n52\t4\tPinus nigra\t21\n", {.lat = "N", .lon = "E", .species = "Baum", .height = "H"});
  REQUIRE(named.trees.size() == 1);
  CHECK(named.trees[0].species == PlantSpecies::pine);
  CHECK(named.trees[0].kind == PlantKind::conifer);
  CHECK(named.trees[0].height == 21);
  CHECK_THROWS_WITH(csv("lat,lon\n1,2\n", {.height = "h"}), Catch::Contains("no column 'h'"));
  CHECK_THROWS_WITH(csv("a,b\n1,2\n"), Catch::Contains("no columns of places"));
  CHECK_THROWS_WITH(csv(""), Catch::Contains("no columns of places"));
}

TEST_CASE("x and y are of the reference system") {
  const CityFeatures city = csv("x,y\n155000,463000\n155030,463040\n", {}, {.reference_system = "EPSG:28992"});
  REQUIRE(city.trees.size() == 2);
  CHECK(glm::distance(city.trees[0].position, city.trees[1].position) == Approx(50).epsilon(1e-3));
  CHECK(city.frame.anchor().lat_deg == Approx(52.155).margin(0.01));
  CHECK(made::listed(csv("x,y\n1,2\n"), "file", "without a reference system"));
}

TEST_CASE("broken rows are told one by one") {
  const auto file = data_file("broken/treelist/bad-rows.csv");
  if (!file) return;
  const CityFeatures city = read_tree_list(*file, {}, {});
  REQUIRE(city.trees.size() == 4);  // two of them with heights by rule
  CHECK(city.trees[0].species == PlantSpecies::lime);
  CHECK(city.trees[0].height == 14);
  CHECK(city.trees[0].crown_radius == 4);
  CHECK(city.trees[3].species == PlantSpecies::oak);
  CHECK(city.trees[3].height == 21);
  for (const char* line : {"line 3", "line 4", "line 5", "line 6", "line 7", "line 8", "line 9", "line 10"})
    CHECK(made::listed(city, line, ""));
  CHECK_FALSE(made::listed(city, "line 11", ""));
}

TEST_CASE("odd GeoJSON is told feature by feature") {
  const auto mixed = data_file("broken/treelist/mixed-geometry.geojson"),
             empty = data_file("broken/treelist/empty.geojson");
  if (!mixed || !empty) return;
  const CityFeatures city = read_tree_list(*mixed, {}, {});
  CHECK(city.trees.size() == 3);
  CHECK(city.issues.size() == 3);
  CHECK(read_tree_list(*empty, {}, {}).trees.empty());
  CHECK(made::listed(read_tree_list(*empty, {}, {}), "file", "no trees"));
}

TEST_CASE("real lists hold what the manifest says") {
  const auto seven = data_file("treelist/barcelona-7-districts.csv"),
             old = data_file("treelist/barcelona-ciutat-vella.geojson");
  const auto berlin = data_file("treelist/berlin-lichtenberg-trees.geojson"),
             crowns = data_file("treelist/berlin-lichtenberg-crowns.geojson");
  const auto bei = data_file("treelist/forest-stand-bei.csv");
  if (!seven || !old || !berlin || !crowns || !bei) return;
  CHECK(read_tree_list(*seven, {}, {}).trees.size() == 98914);
  const CityFeatures city = read_tree_list(*old, {.species = "sn"}, {});
  CHECK(city.trees.size() == 8267);
  CHECK(std::ranges::count(city.trees, PlantSpecies::palm, [](const TreeFeature& t) { return *t.species; }) > 100);
  CHECK(read_tree_list(*bei, {}, {}).trees.size() == 3604);
  const TreeColumns columns{.height = "h_tree"};
  const CityFeatures points = read_tree_list(*berlin, columns, {}), outlines = read_tree_list(*crowns, columns, {});
  REQUIRE(points.trees.size() == 288);
  REQUIRE(outlines.trees.size() == 288);
  double low = 1e300, high = 0;
  for (const TreeFeature& tree : points.trees) low = std::min(low, tree.height), high = std::max(high, tree.height);
  CHECK(low == 2.33);
  CHECK(high == 21.34);
}

TEST_CASE("bytes of lists changed at random end with trees or one line") {
  const std::string good = "latitude,longitude,species,height\n52,4,\"Acer, x\",12\n52.1,4.1,Tilia,9\n";
  const std::string json =
      R"({"features":[{"geometry":{"type":"Polygon","coordinates":[[[4,52],[4.1,52],[4,52.1]]]},"properties":{"height":"7"}}]})";
  support::Random random(3);
  for (int round = 0; round < 4000; ++round) {
    std::string bytes = round % 2 == 0 ? good : json;
    for (int k = random.below(4); k >= 0; --k)
      bytes[static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())))] =
          static_cast<char>(random.below(256));
    try {
      for (const TreeFeature& tree : read_tree_bytes(bytes, round % 2 == 1, {}, {}).trees)
        REQUIRE((tree.height > 0 && tree.crown_radius > 0 && glm::length(tree.position) < 1e6));
    } catch (const std::runtime_error&) {
    }
  }
}
