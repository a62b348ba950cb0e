// What files say of things is kept, each text once, and found again by the objects of the scene.
#include "scenegraph/attributes.h"

#include <catch2/catch.hpp>
#include <set>

#include "scenegraph/import/import.h"
#include "scenegraph/import/tree_list.h"
#include "tests/import/cityjson/made.h"

using namespace manzana;

namespace {

Imported built(CityFeatures features) { return build_scene(std::move(features), {.cars = 0, .attributes = true}, {}); }

/// Values of a name over the objects of a layer.
std::multiset<std::string> values(const Scene& scene, const LayerTable& table, std::string_view name) {
  std::multiset<std::string> found;
  for (std::uint32_t o = 0; o < scene.tree.objects(); ++o)
    if (table.row_first[o] < table.row_first[o + 1])
      if (const auto value = scene.attributes.of(o).find(name)) found.insert(std::string(*value));
  return found;
}

}  // namespace

TEST_CASE("attributes: each text and each row is kept once") {
  AttributeWriter writer(true);
  const std::uint32_t a = writer.row({{"species", "Tilia"}, {"height", "12.5 m"}, {"species", "Acer"}});
  const std::uint32_t b = writer.row({{"height", "12.5 m"}}),
                      c = writer.row({{"species", "Tilia"}, {"height", "12.5 m"}});
  CHECK(a != 0);
  CHECK(b != a);
  CHECK(c == a);
  CHECK(writer.row({}) == 0);
  const Attributes table = writer.take();
  CHECK(table.text == std::string("\0species\0Tilia\0height\0"
                                  "12.5 m\0Acer\0",
                                  35)
                          .substr(0, table.text.size()));
  CHECK(table.row(a).size() == 2);
  CHECK(table.row(a).find("species") == "Tilia");
  CHECK(table.row(a).number("height") == 12.5);
  CHECK_FALSE(table.row(a).number("species"));
  CHECK_FALSE(table.row(b).find("species"));
  CHECK(table.row(0).size() == 0);
  CHECK(AttributeRow().size() == 0);
  AttributeWriter other(true), none(false);
  CHECK(other.row(table.row(a)) == 1);
  CHECK(other.table().row(1).find("height") == "12.5 m");
  CHECK(none.row(table.row(a)) == 0);
  CHECK(none.table().text.empty());
}

TEST_CASE("attributes: a thing's id in its file is its first pair and lists stay shared") {
  AttributeWriter writer(true);
  const std::uint32_t a = writer.row({{"natural", "tree"}}, "node/1"), b = writer.row({{"natural", "tree"}}, "node/2"),
                      c = writer.row({{"natural", "tree"}}), bare = writer.row({}, "node/3");
  CHECK(writer.row({{"natural", "tree"}}, "node/2") == b);
  const Attributes& table = writer.table();
  CHECK(table.pairs.size() == 1);
  CHECK(table.row(a).source() == "node/1");
  REQUIRE(table.row(b).size() == 2);
  CHECK(table.row(b)[0] == std::pair<std::string_view, std::string_view>(kSourceId, "node/2"));
  CHECK(table.row(b)[1] == std::pair<std::string_view, std::string_view>("natural", "tree"));
  CHECK(table.row(c).size() == 1);
  CHECK(table.row(c).source().empty());
  CHECK(table.row(bare).size() == 1);
  CHECK(table.row(bare).find(kSourceId) == "node/3");
  AttributeWriter other(true);
  CHECK(other.table().row(other.row(table.row(b))).source() == "node/2");
}

TEST_CASE("attributes: tags of OpenStreetMap are those of the objects") {
  const Imported with = import_city(MANZANA_VILLAGE, {.cars = 0, .attributes = true}, {});
  const Scene& scene = with.scene;
  REQUIRE(scene.attributes.row_of_object.size() == scene.tree.objects());
  CHECK(values(scene, scene.buildings.table, "building").size() > 10);
  CHECK(values(scene, scene.surfaces.table, "highway").size() > 10);
  CHECK_FALSE(values(scene, scene.trees.table, "natural").empty());
  const Imported without = import_city(MANZANA_VILLAGE, {.cars = 0}, {});
  CHECK(without.scene.attributes.row_of_object.empty());
  CHECK(bytes_of(without.scene.attributes) <= sizeof(std::uint32_t));
  CHECK(without.scene.tree.object_order == scene.tree.object_order);
}

TEST_CASE("attributes: of CityJSON the root's come first and the parts' where it says nothing") {
  made::Json json = made::one_building();
  json["CityObjects"]["house"]["attributes"] = {{"owner", "town"}, {"storeys", 3}, {"gone", nullptr}};
  json["CityObjects"]["house"]["children"] = {"part"};
  json["CityObjects"]["part"] = {
      {"type", "BuildingPart"}, {"parents", {"house"}}, {"attributes", {{"owner", "someone"}, {"roof", "tiles"}}}};
  json["CityObjects"]["tree"] = {{"type", "SolitaryVegetationObject"},
                                 {"attributes", {{"species", "Quercus robur"}}},
                                 {"geometry", {{{"type", "MultiPoint"}, {"lod", "0"}, {"boundaries", {0, 7}}}}}};
  const Scene scene = built(made::read(json, {.attributes = true})).scene;
  using Values = std::multiset<std::string>;
  CHECK(values(scene, scene.buildings.table, "owner") == Values{"town"});
  CHECK(values(scene, scene.buildings.table, "storeys") == Values{"3"});
  CHECK(values(scene, scene.buildings.table, "roof") == Values{"tiles"});
  CHECK(values(scene, scene.buildings.table, "type") == Values{"Building"});
  CHECK(values(scene, scene.buildings.table, "gone").empty());
  CHECK(values(scene, scene.trees.table, "species") == Values{"Quercus robur"});
}

TEST_CASE("attributes: columns and properties of lists of trees and of several sources") {
  CityFeatures city =
      read_tree_bytes("lat,lon,species,owner\n52,4,Acer,town\n52.001,4,Tilia,\n", false, {}, {.attributes = true});
  merge(city, read_tree_bytes(R"({"features":[{"properties":{"owner":"school","age":12},
    "geometry":{"type":"Point","coordinates":[4.001,52]}}]})",
                              true, {}, {.attributes = true}));
  const Scene scene = built(std::move(city)).scene;
  using Values = std::multiset<std::string>;
  CHECK(values(scene, scene.trees.table, "owner") == Values{"school", "town"});
  CHECK(values(scene, scene.trees.table, "species") == Values{"Acer", "Tilia"});
  CHECK(values(scene, scene.trees.table, "age") == Values{"12"});
}
