// What things are known by in real files is found again: every id that the scene gives is one of its file's.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "scenegraph/import/baked_city.h"
#include "scenegraph/import/import.h"
#include "scenegraph/import/tree_list.h"
#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Of all objects of a layer; "" of those that have none.
std::vector<std::string> ids(const Scene& scene, const LayerTable& table) {
  std::vector<std::string> all;
  for (std::uint32_t o = 0; o < scene.tree.objects(); ++o)
    if (table.row_first[o] < table.row_first[o + 1]) all.emplace_back(scene.attributes.of(o).source());
  return all;
}

}  // namespace

TEST_CASE("source ids: of OpenStreetMap they are its ways and relations and nodes with the tags that it has there") {
  const auto file = data_file("tiny/helsinki-block.osm");
  if (!file) return;
  const std::string xml = text_of(*file);
  const Scene scene = import_city(*file, {.cars = 0, .attributes = true}, {}).scene;
  const auto buildings = ids(scene, scene.buildings.table);
  REQUIRE(buildings.size() > 5);
  for (const std::string& id : buildings) {
    INFO(id);
    const std::size_t slash = id.find('/');
    REQUIRE(slash != std::string::npos);
    const std::string kind = id.substr(0, slash);
    const std::size_t at = xml.find(kind + " id=\"" + id.substr(slash + 1) + "\"");
    REQUIRE(at != std::string::npos);
    const std::string element = xml.substr(at, xml.find(kind + ">", at) - at);
    CHECK(element.find("k=\"building") != std::string::npos);
  }
  for (const std::string& id : ids(scene, scene.trees.table))
    if (id.starts_with("node/")) CHECK(xml.find("<node id=\"" + id.substr(5) + "\"") != std::string::npos);
}

TEST_CASE("source ids: of CityJSON they are the names of its objects") {
  const auto file = data_file("tiny/denhaag-subset.city.json");
  if (!file) return;
  const auto objects = nlohmann::json::parse(text_of(*file)).at("CityObjects");
  const Scene scene = import_city(*file, {.cars = 0, .attributes = true}, {}).scene;
  std::set<std::string> found, expected;
  for (const std::string& id : ids(scene, scene.buildings.table)) found.insert(id);
  for (const auto& [name, object] : objects.items())
    if (object.at("type") == "Building") expected.insert(name);
  CHECK(found == expected);
}

TEST_CASE("source ids: of lists of trees they are a column or a feature's own") {
  const CityFeatures csv = read_tree_bytes("id,lat,lon\nT-7,52,4\n,52.001,4\n", false, {}, {.attributes = true});
  REQUIRE(csv.trees.size() == 2);
  CHECK(csv.attributes.table().row(csv.trees[0].attributes).source() == "T-7");
  CHECK(csv.attributes.table().row(csv.trees[1].attributes).source().empty());
  const CityFeatures json = read_tree_bytes(R"({"features":[
    {"id":12,"properties":{"id":"other"},"geometry":{"type":"Point","coordinates":[4,52]}},
    {"properties":{"id":"mine"},"geometry":{"type":"Point","coordinates":[4.001,52]}},
    {"id":"bare","properties":null,"geometry":{"type":"Point","coordinates":[4.002,52]}}]})",
                                            true, {}, {.attributes = true});
  std::vector<std::string> found;
  for (const TreeFeature& tree : json.trees) found.emplace_back(json.attributes.table().row(tree.attributes).source());
  CHECK(found == std::vector<std::string>{"12", "mine", "bare"});
}

TEST_CASE("source ids: a baked city has those that it was made of") {
  const auto file = data_file("tiny/helsinki-block.osm");
  if (!file) return;
  const TemporaryFolder folder;
  const Imported city = import_city(*file, {.cars = 0, .attributes = true}, {});
  const auto baked = folder.path() / "block.manzana";
  write_baked(baked, city);
  const Imported again = import_city(baked, {}, {});
  CHECK(ids(again.scene, again.scene.buildings.table) == ids(city.scene, city.scene.buildings.table));
}
