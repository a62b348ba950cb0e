// A baked city is the city; a damaged or older one is told in a line, and nothing that is read can crash who uses it.
#include "scenegraph/import/baked_city.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>

#include "scenegraph/import/picture_square.h"
#include "scenegraph/tree_sites.h"
#include "scenegraph/visible.h"
#include "tests/import/baked/resummed.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;

namespace {

const Imported& village() {
  static const Imported city = [] {
    Imported made = import_city(MANZANA_VILLAGE, {.cars = 60, .attributes = true}, {});
    MeshRows& level = made.scene.buildings.levels[1];  // of its last building: one triangle
    level.index_first.back() = 3;
    level.mesh.indices.own() = {0, 1, 2};
    const auto all = made.scene.buildings.mesh.vertices.items();
    level.mesh.vertices.own().assign(all.end() - 3, all.end());
    level.mesh.textures.own() = {2, 2, 2};
    made.scene.buildings.mesh.textures.own().assign(all.size() / 2, 1);
    made.scene.pictures.textures = {{1, Wrap::repeat, 0}, {0, Wrap::border, 0xff00ff00}};
    for (const std::size_t bytes : {300, 500}) {
      EncodedPicture& picture = made.scene.pictures.encoded.emplace_back();
      picture.bytes.own().resize(bytes, static_cast<std::byte>(bytes / 100));
      picture.width = 40, picture.height = 30, picture.worn = {1, 2, 20, 10};
    }
    return made;
  }();
  return city;
}
const std::string& baked_village() {
  static const std::string bytes = baked_bytes(village());
  return bytes;
}

Imported read(const std::string& bytes) {
  return read_baked_bytes(std::as_bytes(std::span(bytes.data(), bytes.size())), "x.manzana");
}

/// What is wrong with it; empty: nothing. Always one line.
std::string fault(const std::string& bytes) {
  try {
    (void)read(bytes);
    return {};
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    CHECK(what.starts_with("x.manzana: "));
    CHECK(what.find('\n') == std::string::npos);
    return what;
  }
}

/// All that a program does with a scene, without GL.
std::size_t use(const Scene& scene) {
  VisibleSets sets(scene);
  std::size_t used = 0;
  for (const double height : {2.0, 80.0, 1e5}) {
    const Vec3d at = scene.bounds.empty() ? Vec3d(0) : center(scene.bounds);
    find_visible(scene, culling::look(at + Vec3d(0, 0, height), {0.3, 0.4, -0.7}, {0, 0, 1}, 1, 1), Structure::bqr,
                 sets);
    find_cars(scene, 123456789, sets);
    used += count(scene.buildings.table, sets.objects()) + count(scene.trees.table, sets.objects()) + sets.cars.size();
    for (const culling::ObjectRun& run : sets.objects())
      for (std::uint32_t o = run.first; o < run.last; ++o)
        for (std::size_t i = 0; i < scene.attributes.of(o).size(); ++i)
          used += scene.attributes.of(o)[i].second.size() & 1;
  }
  for (const std::uint32_t texture : scene.buildings.mesh.textures)
    if (texture > 0) used += scene.pictures.encoded[scene.pictures.textures[texture - 1].picture].bytes.size() & 1;
  for (const EncodedPicture& picture : scene.pictures.encoded)
    used += side_of(picture) > kLargestSquare || picture_square(picture, 8) ? 1 : 0;
  return used;
}

}  // namespace

TEST_CASE("baked: the same city comes back") {
  const Imported back = read(baked_village());
  const Scene &a = village().scene, &b = back.scene;
  CHECK(baked_bytes(back) == baked_village());
  CHECK(a.tree.objects() == b.tree.objects());
  CHECK(std::memcmp(a.tree.nodes.data(), b.tree.nodes.data(), a.tree.nodes.size() * sizeof(a.tree.nodes[0])) == 0);
  CHECK(a.frame.anchor().lat_deg == b.frame.anchor().lat_deg);
  CHECK(a.buildings.mesh.indices == b.buildings.mesh.indices);
  CHECK(a.buildings.levels[1].mesh.indices == b.buildings.levels[1].mesh.indices);
  CHECK(a.buildings.levels[1].index_first == b.buildings.levels[1].index_first);
  CHECK(a.buildings.mesh.textures == b.buildings.mesh.textures);
  CHECK(a.buildings.levels[1].mesh.textures == b.buildings.levels[1].mesh.textures);
  CHECK(a.pictures.textures == b.pictures.textures);
  REQUIRE(b.pictures.encoded.size() == 2);
  for (std::size_t p = 0; p < 2; ++p) {
    CHECK(a.pictures.encoded[p].bytes == b.pictures.encoded[p].bytes);
    CHECK(a.pictures.encoded[p].worn == b.pictures.encoded[p].worn);
    CHECK(b.pictures.encoded[p].name.empty());  // it refers to no other file
  }
  CHECK(a.traffic.offsets == b.traffic.offsets);
  CHECK(a.attributes.text == b.attributes.text);
  CHECK(a.attribution == b.attribution);
  CHECK(back.report.blocks == village().report.blocks);
  CHECK(use(a) == use(b));
  CHECK(use(a) > 50);
}

TEST_CASE("baked: what neighbours hide is found again for the same plants alone") {
  Imported city = village();
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  for (foliage::PreparedPlant& plant : plants) plant.crown_radius_m = 3, plant.height_m = 12, plant.cover_m2 = 40;
  const auto plain = tree_sites(city.scene, plants);
  keep_leeway(city.scene, plants);
  Scene back = read(baked_bytes(city)).scene;
  REQUIRE(back.trees.leeway.size() == plain.size());
  const auto same = [](const foliage::TreeSite& a, const foliage::TreeSite& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
  };
  CHECK(std::ranges::equal(tree_sites(back, plants), plain, same));
  for (TreeLeeway& row : back.trees.leeway.own()) row.fill(77);
  CHECK(tree_sites(back, plants)[0].leeway[0] == 77);
  for (foliage::PreparedPlant& plant : plants) plant.cover_m2 = 41;
  CHECK(tree_sites(back, plants)[0].leeway[0] != 77);
}

TEST_CASE("baked: a scene of nothing too") {
  const Imported back = read(baked_bytes(build_scene(CityFeatures(), {}, {})));
  CHECK(back.scene.tree.objects() == 0);
  CHECK(use(back.scene) == 0);
}

TEST_CASE("baked: a file is read by its name as any other city is") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "village.manzana";
  write_baked(file, village());
  CHECK(import_city(file.string(), {}, {}).scene.tree.objects() == village().scene.tree.objects());
  CHECK_THROWS_WITH(import_city((folder.path() / "none.manzana").string(), {}, {}), Catch::EndsWith("no such file"));
  CHECK_THROWS_WITH(read_baked(folder.path()), Catch::EndsWith("is no file"));
  CHECK_THROWS_WITH(read_city(file.string(), {}, {}), Catch::Contains("stands on its ground already"));
}

TEST_CASE("baked: one wrong bit anywhere is told") {
  support::Random random(1);
  const std::string& good = baked_village();
  const auto check = [&](std::size_t place) {
    std::string bytes = good;
    bytes[place] = static_cast<char>(bytes[place] ^ 1 << random.below(8));
    INFO("byte " << place);
    CHECK_FALSE(fault(bytes).empty());
  };
  const std::size_t n = baked::sections(good);
  REQUIRE(n == 52);
  for (std::size_t place = 0; place < baked::kHeader + n * baked::kSection; ++place) check(place);
  for (std::size_t i = 0; i < n; ++i) {
    const baked::Place section = baked::section(good, i);
    for (int round = 0; round < 6 && section.bytes > 0; ++round)
      check(section.offset + static_cast<std::size_t>(random.bits() % section.bytes));
  }
}

TEST_CASE("baked: what is cut off or comes after is told and so is an older file") {
  const std::string& good = baked_village();
  support::Random random(2);
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{39}, std::size_t{40}, good.size() - 1})
    CHECK_FALSE(fault(good.substr(0, size)).empty());
  for (int i = 0; i < 40; ++i) CHECK_FALSE(fault(good.substr(0, random.bits() % good.size())).empty());
  CHECK_FALSE(fault(good + "x").empty());
  std::string older = good;
  baked::put<std::uint32_t>(older, 8, 0);
  CHECK(fault(older) == "x.manzana: is of version 0, this program reads version 4; bake it again");
  CHECK(fault("<osm version='0.6'></osm>") == "x.manzana: is no baked city");
  std::string other = good;
  baked::put<std::uint32_t>(other, 12, 0x04030201);
  CHECK(fault(other).find("byte order") != std::string::npos);
}

TEST_CASE("baked: nothing that is read with checksums that fit can crash who uses it") {
  support::Random random(3);
  const std::string& good = baked_village();
  const std::size_t n = baked::sections(good);
  std::size_t refused = 0, used = 0;
  for (int round = 0; round < 1500; ++round) {
    std::string bytes = good;
    const baked::Place section = baked::section(good, static_cast<std::size_t>(round) % n);
    if (section.bytes == 0) continue;
    const std::size_t place = section.offset + static_cast<std::size_t>(random.bits() % section.bytes);
    const int how = random.below(3);
    if (how == 0) bytes[place] = static_cast<char>(bytes[place] ^ 1 << random.below(8));
    if (how == 1) bytes[place] = static_cast<char>(random.bits());
    if (how == 2) baked::put<std::uint32_t>(bytes, std::min(place / 4 * 4, bytes.size() - 4), ~0U);
    baked::resum(bytes);
    try {
      used += use(read(bytes).scene) > 0 ? 1 : 0;
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  CHECK(refused > 300);
  CHECK(used > 100);
}

namespace {

/// Of files, in this process's memory.
std::size_t resident_file_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("RssFile:")) return std::stoull(line.substr(8)) * 1024;
  return 0;
}

}  // namespace

TEST_CASE("baked: meshes stay in the file and come when they are read and go") {
  const TemporaryFolder folder;
  const Imported town = import_city("builtin:town", {.cars = 0}, {});
  write_baked(folder.path() / "town.manzana", town);
  (void)read_baked(folder.path() / "town.manzana");  // the code is in memory then
  const std::size_t before = resident_file_bytes();
  const Imported back = read_baked(folder.path() / "town.manzana");
  std::filesystem::remove(folder.path() / "town.manzana");  // what is mapped stays
  const StoredMesh& mesh = back.scene.buildings.mesh;
  const std::size_t bytes = mesh.vertices.items().size_bytes() + mesh.indices.items().size_bytes();
  REQUIRE(mesh.vertices.mapped());
  REQUIRE(bytes > 1'000'000);
  const auto held = [&] { return static_cast<double>(resident_file_bytes()) - static_cast<double>(before); };
  CHECK(held() < 0.5 * static_cast<double>(bytes));  // beside them other columns' pages
  CHECK(std::memcmp(mesh.vertices.data(), town.scene.buildings.mesh.vertices.data(),
                    mesh.vertices.items().size_bytes()) == 0);
  CHECK(held() > 0.5 * static_cast<double>(bytes));
  mesh.vertices.let_go(0, mesh.vertices.size());
  CHECK(held() < 0.5 * static_cast<double>(bytes));
  CHECK(mesh.indices == town.scene.buildings.mesh.indices);
}
