// Tilesets: what is in them, where, and that nothing is there when they cannot be written.
#include "scenegraph/export/tiles.h"

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "foliage/leaf_image.h"
#include "scenegraph/earth_centred.h"
#include "scenegraph/export/tile_content.h"
#include "scenegraph/export/tile_tree.h"
#include "scenegraph/import/scene_plants.h"
#include "tests/export/tile_checker.h"
#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace manzana;
using Path = std::filesystem::path;
using Json = nlohmann::json;

std::vector<foliage::PreparedPlant> plants_of(const Scene& scene) {
  return scene_plants(scene, {.cache = foliage::default_cache_folder()}, {}, [](const std::string&) {});
}

struct Baked {
  TemporaryFolder folder;
  Imported city;
  TilesWritten written;
  Path tiles() const { return folder.path() / "tiles"; }
  Json tileset() const { return Json::parse(read_all(tiles() / "tileset.json")); }

  explicit Baked(const std::string& file, const ImportOptions& options = {.cars = 0})
      : city(import_city(file, options, {})), written(write_tiles(city.scene, plants_of(city.scene), tiles())) {}
};

double distance_to_triangle(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a = t[i], ab = t[(i + 1) % 3] - a;
    const double along = glm::dot(ab, ab) > 0 ? std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0) : 0;
    nearest = std::min(nearest, glm::distance(p, a + along * ab));
  }
  const Vec3d normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  for (std::size_t i = 0; i < 3; ++i)
    if (glm::dot(glm::cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) < 0) return nearest;
  const double size = glm::length(normal);
  return size > 0 ? std::min(nearest, std::abs(glm::dot(p - t[0], normal)) / size) : nearest;
}

double distance_to(const Vec3d& p, const std::vector<TileTriangle>& triangles) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const TileTriangle& t : triangles) nearest = std::min(nearest, distance_to_triangle(p, t.corners));
  return nearest;
}

void check_real(const std::string& file, const ImportOptions& options = {.cars = 0}) {
  const auto path = data_file(file);
  if (!path) return;
  const Baked baked(*path, options);
  const CheckedTiles checked = check_tiles(baked.tiles());
  std::printf("%s: %zu tiles, %zu instances, %zu vertices, %zu features checked, %.1f MB\n", file.c_str(),
              checked.tiles, checked.instances, checked.vertices, checked.features,
              static_cast<double>(baked.written.bytes) / 1e6);
  CHECK(checked.faults == std::vector<std::string>());
  CHECK(checked.tiles == baked.written.tiles);
}

}  // namespace

TEST_CASE("tiles: the village has every vertex of every instance within its volumes") {
  const Baked baked(MANZANA_VILLAGE);
  const CheckedTiles checked = check_tiles(baked.tiles());
  CHECK(checked.faults == std::vector<std::string>());
  CHECK(checked.tiles == baked.written.tiles);
  CHECK(checked.contents + 1 + files_in(baked.tiles() / "plants") == baked.written.files);  // and tileset.json
  CHECK(checked.instances > baked.city.scene.trees.table.size());
  CHECK(files_in(baked.folder.path()) == 1);
}

TEST_CASE("tiles: the same again is the same to the byte") {
  const Baked baked(MANZANA_VILLAGE);
  const Path again = baked.folder.path() / "again";
  write_tiles(baked.city.scene, plants_of(baked.city.scene), again);
  CHECK(read_all(again / "tileset.json") == read_all(baked.tiles() / "tileset.json"));
  CHECK(files_in(again / "tiles") == files_in(baked.tiles() / "tiles"));
  for (const auto& entry : std::filesystem::directory_iterator(again / "tiles"))
    CHECK(read_all(entry.path()) == read_all(baked.tiles() / "tiles" / entry.path().filename()));
  for (const auto& entry : std::filesystem::directory_iterator(again / "plants"))
    CHECK(read_all(entry.path()) == read_all(baked.tiles() / "plants" / entry.path().filename()));
}

TEST_CASE("tiles: the leaves hold all buildings and trees with their heights") {
  const Baked baked(MANZANA_VILLAGE);
  const Scene& scene = baked.city.scene;
  std::multiset<float> heights, expected;
  std::size_t buildings = 0;
  const std::function<void(const Json&)> visit = [&](const Json& tile) {
    if (tile.contains("children")) return static_cast<void>(std::ranges::for_each(tile.at("children"), visit));
    for (const Json& one : tile.at("contents")) {
      const DecodedContent content = decode_content(baked.tiles() / one.at("uri").get<std::string>());
      if (content.numbers.contains("tree.height"))
        heights.insert(content.numbers.at("tree.height").begin(), content.numbers.at("tree.height").end());
      if (content.texts.contains("building.id")) buildings += content.texts.at("building.id").size();
      if (content.texts.contains("tree.species"))
        for (const std::string& name : content.texts.at("tree.species")) CHECK_FALSE(name.empty());
    }
  };
  visit(baked.tileset().at("root"));
  for (const TreeInstance& tree : scene.trees.instances)
    if (static_cast<double>(tree.height_m) > kLeafError) expected.insert(tree.height_m);
  CHECK(heights == expected);
  CHECK(buildings == scene.buildings.table.size());
}

TEST_CASE("tiles: buildings and trees have the ids of their files") {
  for (const char* name : {"tiny/triesen-trees.osm.pbf", "tiny/denhaag-subset.city.json"}) {
    const auto path = data_file(name);
    if (!path) return;
    const Baked baked(*path, {.cars = 0, .attributes = true});
    const Scene& scene = baked.city.scene;
    std::multiset<std::string> buildings, trees, expected, of_trees;
    const std::function<void(const Json&)> visit = [&](const Json& tile) {
      if (tile.contains("children")) return static_cast<void>(std::ranges::for_each(tile.at("children"), visit));
      for (const Json& one : tile.at("contents")) {
        auto texts = decode_content(baked.tiles() / one.at("uri").get<std::string>()).texts;
        for (const std::string& id : texts["building.source_id"]) buildings.insert(id);
        for (const std::string& id : texts["tree.source_id"]) trees.insert(id);
      }
    };
    visit(baked.tileset().at("root"));
    for (std::uint32_t row = 0; row < scene.buildings.table.size(); ++row)
      expected.insert(source_of(scene, scene.buildings.table, row));
    for (std::uint32_t row = 0; row < scene.trees.table.size(); ++row)
      if (static_cast<double>(scene.trees.instances[row].height_m) > kLeafError)
        of_trees.insert(source_of(scene, scene.trees.table, row));
    CHECK(buildings == expected);
    CHECK(trees == of_trees);
    CHECK(expected.count("") == 0);
    CHECK(expected.size() + of_trees.size() > of_trees.count(""));
  }
}

TEST_CASE("tiles: buildings have the names and classes that the file gives them") {
  const Imported city = import_city(MANZANA_VILLAGE, {.cars = 0, .attributes = true}, {});
  std::multiset<std::string> told, expected;
  for (std::uint32_t row = 0; row < city.scene.buildings.table.size(); ++row) {
    const BuildingRow building = building_row(city.scene, row);
    CHECK(!building.id.empty());
    CHECK(!building.kind.empty());
    if (!building.name.empty()) told.insert(building.name);
  }
  for (std::uint32_t object = 0; object < city.scene.tree.objects(); ++object) {
    const auto rows = city.scene.buildings.table.rows({object, object + 1});
    if (rows.first == rows.last) continue;
    if (const auto name = city.scene.attributes.of(object).find("name")) expected.emplace(*name);
  }
  CHECK(told == expected);
  CHECK(!told.empty());
}

TEST_CASE("tiles: a tree stands where it stands in the scene as large and turned") {
  const Baked baked(MANZANA_VILLAGE);
  const Scene& scene = baked.city.scene;
  const auto plants = plants_of(scene);
  for (const Tile& tile : tile_tree(scene)) {
    const TileContent content = tile_content(scene, tile, plants);
    for (const auto& [plant, trees] : content.trees)
      for (const TreeRow& tree : trees) {
        const Vec3d tip =
            tile.frame.to_local(tree.foot + tree.turn * (tree.scale * Vec3(0, 0, plants[plant].height_m)));
        double nearest = std::numeric_limits<double>::infinity();
        for (const TreeInstance& in : scene.trees.instances)
          nearest = std::min(nearest, glm::distance(tip, scene.blocks[in.block].to_local(Vec3d(in.position) +
                                                                                         Vec3d(0, 0, in.height_m))));
        CHECK(nearest < 1e-3);
      }
  }
}

TEST_CASE("tiles: no building's vertex is farther from what a coarse tile shows than its error") {
  const Baked baked(MANZANA_VILLAGE);
  const Scene& scene = baked.city.scene;
  const std::vector<Tile> tiles = tile_tree(scene);
  bool coarse = false;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (tiles[t].leaf) continue;
    const DecodedContent content = decode_content(baked.tiles() / ("tiles/" + std::to_string(t) + "-city.glb"));
    double worst = 0;
    for (const std::uint32_t block : tiles[t].blocks) {
      const Placement place = placement(scene.blocks[block], tiles[t].frame);
      const auto [first, last] = scene.buildings.table.rows(scene.tree.block_objects[block]);
      for (std::uint32_t i = first; i < last; ++i) {
        const MeshRow row = row_of(scene.buildings, i);
        for (std::uint32_t v = row.first; v < row.last; ++v)
          worst =
              std::max(worst, distance_to(place(Vec3d(scene.buildings.mesh.vertices[v].position)), content.buildings));
      }
    }
    CHECK(worst <= tiles[t].error_m + 1e-3);
    coarse = coarse || worst > 1;
  }
  CHECK(coarse);
}

TEST_CASE("tiles: the root lies on the Earth where the city is") {
  const Baked baked(MANZANA_VILLAGE);
  const Scene& scene = baked.city.scene;
  const Json transform = baked.tileset().at("root").at("transform");
  Mat4d to_earth;
  for (int i = 0; i < 16; ++i) to_earth[i / 4][i % 4] = transform[static_cast<std::size_t>(i)];
  const BlockFrame root = tile_tree(scene)[0].frame;
  const GeoPoint place = scene.frame.to_geo(root.to_local({10, 20, 5}));
  const LocalFrame there(place);
  CHECK(glm::distance(Vec3d(to_earth * Vec4d(10, 20, 5, 1)), Vec3d(local_to_ecef(there)[3])) < 1e-6);
  CHECK(glm::distance(Vec3d(to_earth[2]), Vec3d(local_to_ecef(there)[2])) < 1e-5);  // its up is up
}

TEST_CASE("tiles: the checker sees a sphere that is too small") {
  const Baked baked(MANZANA_VILLAGE);
  Json tileset = baked.tileset();
  double& radius = tileset["root"]["boundingVolume"]["sphere"][3].get_ref<double&>();
  radius *= 0.9;
  std::ofstream(baked.tiles() / "tileset.json") << tileset;
  CHECK_FALSE(check_tiles(baked.tiles()).faults.empty());
}

TEST_CASE("tiles: the checker sees an instance beside its tile") {
  const Baked baked(MANZANA_VILLAGE);
  Json tileset = baked.tileset();
  const std::function<bool(Json&)> swap = [&](Json& tile) {  // the leaf of a tree gets a box without room for it
    if (tile.contains("children")) {
      for (Json& child : tile["children"])
        if (swap(child)) return true;
      return false;
    }
    if (!tile["contents"].back()["uri"].get<std::string>().ends_with("-trees.glb")) return false;
    tile["boundingVolume"]["box"][2] = tile["boundingVolume"]["box"][2].get<double>() - 1;  // its top is a tree's
    return true;
  };
  REQUIRE(swap(tileset["root"]));
  std::ofstream(baked.tiles() / "tileset.json") << tileset;
  const CheckedTiles checked = check_tiles(baked.tiles());
  CHECK(std::ranges::any_of(checked.faults,
                            [](const std::string& f) { return f.ends_with("a vertex is outside its tile's volume"); }));
}

TEST_CASE("tiles: what is there already is left alone") {
  const Baked baked(MANZANA_VILLAGE);
  const std::string before = read_all(baked.tiles() / "tileset.json");
  CHECK_THROWS_WITH(write_tiles(baked.city.scene, plants_of(baked.city.scene), baked.tiles()),
                    Catch::EndsWith("tiles: is there already, and not empty"));
  CHECK(read_all(baked.tiles() / "tileset.json") == before);
  CHECK(files_in(baked.folder.path()) == 1);
}

TEST_CASE("tiles: a folder that cannot be made is told and a scene without objects too") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  const Imported city = import_city(MANZANA_VILLAGE, {.cars = 0}, {});
  CHECK_THROWS_WITH(write_tiles(city.scene, plants_of(city.scene), folder.path() / "file" / "tiles"),
                    Catch::Contains("cannot be made"));
  CHECK_THROWS_WITH(write_tiles(Scene(), plants_of(city.scene), folder.path() / "none"),
                    Catch::EndsWith("none: there is nothing to write"));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("tiles: what stops on the way leaves nothing") {
  const TemporaryFolder folder;
  const Imported city = import_city(MANZANA_VILLAGE, {.cars = 0}, {});
  const auto stop = [](std::string_view, double done) {
    if (done > 0.5) throw std::runtime_error("enough");
  };
  CHECK_THROWS_WITH(write_tiles(city.scene, plants_of(city.scene), folder.path() / "tiles", stop), "enough");
  CHECK(files_in(folder.path()) == 0);
}

TEST_CASE("tiles: buildings have the colours of their materials and textures") {
  const auto file = data_file("tiny/denhaag-subset.city.json");
  if (!file) return;
  const Imported city = import_city(file->string(), {}, {});
  const auto maroon = [](const auto& v) { return glm::distance(v.colour, foliage::linear_of_rgb(0x800000)) < 1e-3F; };
  std::size_t found = 0;
  for (const Tile& tile : tile_tree(city.scene))
    found += static_cast<std::size_t>(
        std::ranges::count_if(tile_content(city.scene, tile, plants_of(city.scene)).buildings_mesh.vertices, maroon));
  CHECK(found > 10);
}

TEST_CASE("tiles: Helsinki of OpenStreetMap") { check_real("osm/helsinki-centre.osm.pbf"); }
TEST_CASE("tiles: Delft of CityJSON") { check_real("citymodel/delft-bgt.city.json"); }
TEST_CASE("tiles: trees of Berlin") { check_real("citymodel/berlin-lichtenberg-trees.city.json"); }
TEST_CASE("tiles: a block on the antimeridian") { check_real("broken/osm/antimeridian-block.osm"); }
TEST_CASE("tiles: a block at the pole") { check_real("broken/osm/polar-block.osm"); }
