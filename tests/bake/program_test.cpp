// The program from outside: exit codes, messages, files.
#include <algorithm>
#include <cstring>

#include "foliage/import/plant_cache.h"
#include "scenegraph/import/baked_city.h"
#include "tests/support/data.h"
#include "tests/support/program.h"

namespace {

using Path = std::filesystem::path;

Ended bake(const Path& folder, const std::string& source) {
  return run_program(MANZANA_BAKE, folder, {"plant", source, "-o", folder / "out.plant"});
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// 0 with a plant that can be read back, or 1 with one line that names the file; little time and memory.
void check_answer(const Path& file) {
  const TemporaryFolder folder;
  const Ended ended = bake(folder.path(), file);
  CAPTURE(file, ended.code, ended.err, ended.cpu_s, ended.memory_mb);
  CHECK((ended.code == 0 || ended.code == 1));
  CHECK(ended.cpu_s < 5 * kSlower);
  CHECK(ended.memory_mb < 400 * kLarger);
  const Path out = folder.path() / "out.plant";
  if (ended.code == 0) {
    manzana::foliage::read_prepared(out);
  } else {
    CHECK(lines_in(ended.err) == 1);
    CHECK(ended.err.starts_with("manzana-bake: " + file.string() + ": "));
    CHECK_FALSE(std::filesystem::exists(out));
  }
}

}  // namespace

TEST_CASE("bake program: a city is imported once and opened again") {
  const TemporaryFolder folder;
  const Path out = folder.path() / "town.manzana";
  const Ended ended = run_program(MANZANA_BAKE, folder.path(), {"import", "builtin:town", "--cars", "20", "-o", out});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  for (const char* said : {"city ", "blocks", "20 cars", "of attributes", "seconds "})
    CHECK_THAT(ended.out, Catch::Contains(said));
  CHECK(manzana::read_baked(out).scene.traffic.cars() == 20);
  const std::string first = read_all(out);
  REQUIRE(run_program(MANZANA_BAKE, folder.path(), {"import", "builtin:town", "--cars", "20", "-o", out}).code == 0);
  CHECK(read_all(out) == first);
  for (const Path& wrong : {folder.path() / "town.osm", folder.path() / "no" / "town.manzana"}) {
    const Ended failed = run_program(MANZANA_BAKE, folder.path(), {"import", "builtin:town", "-o", wrong});
    CHECK(failed.code == 1);
    CHECK_THAT(failed.err, Catch::Contains(wrong.string()));
    CHECK_FALSE(std::filesystem::exists(wrong));
  }
}

TEST_CASE("bake program: a species is prepared, told of, and the same again") {
  const TemporaryFolder folder;
  const Ended ended = bake(folder.path(), MANZANA_SPECIES "/shrub.json");
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  for (const char* said : {"branches ", "terminals ", "level 0 ", "leaves ", "points ", "seconds "})
    CHECK_THAT(ended.out, Catch::Contains(said));
  CHECK_THAT(ended.err, Catch::Contains("preparing: 100 %"));
  const std::string first = read_all(folder.path() / "out.plant");
  CHECK(manzana::foliage::read_prepared(folder.path() / "out.plant").name == "shrub");
  REQUIRE(bake(folder.path(), MANZANA_SPECIES "/shrub.json").code == 0);
  CHECK(read_all(folder.path() / "out.plant") == first);
}

TEST_CASE("bake program: visibility by each way, and who it was") {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> ways[] = {
      {"gpu", "pictures of cell ids"}, {"cpu", "by: CPU\n"}, {"queries", "occlusion queries"}, {"none", "by: none\n"}};
  for (const auto& [way, says] : ways) {
    const Path out = folder.path() / (std::string(way) + ".plant");
    const Ended ended = run_program(MANZANA_BAKE, folder.path(),
                                    {"plant", MANZANA_SPECIES "/shrub.json", "-o", out, "--visibility", way});
    CAPTURE(way, ended.err);
    REQUIRE(ended.code == 0);
    CHECK_THAT(ended.out, Catch::Contains(says));
    const manzana::foliage::PreparedPlant plant = manzana::foliage::read_prepared(out);
    CHECK(plant.visibility.share.empty() == (std::string(way) == "none"));
  }
}

TEST_CASE("bake program: help goes to stdout, wrong usage is 2") {
  const TemporaryFolder folder;
  CHECK_THAT(run_program(MANZANA_BAKE, folder.path(), {"--help"}).out, Catch::Contains("plant"));
  CHECK(run_program(MANZANA_BAKE, folder.path(), {"plant", "a.glb"}).code == 2);
}

TEST_CASE("bake program: bad input is 1 and one line that names the file and the place") {
  const TemporaryFolder folder;
  const auto file = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return (folder.path() / name).string();
  };
  const std::pair<std::string, const char*> cases[] = {
      {folder.path() / "none.glb", "none.glb: no such file"},
      {file("a.txt", ""), "a.txt: is no file of a kind"},
      {file("a.json", "{"), "a.json: "},
      {file("b.json", R"({"scael": 1})"), "b.json: species: scael: unknown key"},
      {file("c.json", R"({"x": {"axiom": "F]", "angle": 1, "n": 1}})"), "c.json: x.axiom: ] without a ["},
      {file("a.obj", "v 1 2 x\n"), "a.obj: line 1: \"x\" is no number"},
      {file("a.glb", "glTF"), "a.glb: cut off"},
  };
  for (const auto& [source, says] : cases) {
    const Ended ended = bake(folder.path(), source);
    CAPTURE(source, ended.err);
    CHECK(ended.code == 1);
    CHECK(lines_in(ended.err) == 1);
    CHECK_THAT(ended.err, Catch::StartsWith("manzana-bake: ") && Catch::Contains(says));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "out.plant"));
  }
}

TEST_CASE("bake program: a city becomes a tileset with progress and counts") {
  const TemporaryFolder folder;
  const Ended ended =
      run_program(MANZANA_BAKE, folder.path(), {"tiles", MANZANA_VILLAGE, "-o", folder.path() / "tiles"});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.out, Catch::Contains("tileset ") && Catch::Contains(" buildings, ") && Catch::Contains("seconds "));
  CHECK_THAT(ended.err, Catch::Contains("tiles: 100 %"));
  CHECK(std::filesystem::exists(folder.path() / "tiles" / "tileset.json"));
}

TEST_CASE("bake program: a city becomes a GeoPackage") {
  const TemporaryFolder folder;
  const Ended ended =
      run_program(MANZANA_BAKE, folder.path(), {"geopackage", MANZANA_VILLAGE, "-o", folder.path() / "city.gpkg"});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.out, Catch::Contains("layers ") && Catch::Contains(" blocks, ") && Catch::Contains(" trees in "));
  CHECK(std::filesystem::file_size(folder.path() / "city.gpkg") > 10000);
}

TEST_CASE("bake program: a city that cannot be read or written is 1 and one line and leaves nothing") {
  const TemporaryFolder folder;
  const std::string none = folder.path() / "none.osm", tiles = folder.path() / "tiles";
  const Ended missing = run_program(MANZANA_BAKE, folder.path(), {"tiles", none, "-o", tiles});
  CHECK(missing.code == 1);
  CHECK_THAT(missing.err, Catch::StartsWith("manzana-bake: " + none + ": "));
  CHECK(lines_in(missing.err) == 1);
  CHECK_FALSE(std::filesystem::exists(tiles));
  const Ended there = run_program(MANZANA_BAKE, folder.path(), {"tiles", MANZANA_VILLAGE, "-o", folder.path()});
  CHECK(there.code == 1);
  CHECK_THAT(there.err, Catch::Contains("is there already, and not empty"));
  CHECK(run_program(MANZANA_BAKE, folder.path(), {"tiles", MANZANA_VILLAGE}).code == 2);
}

TEST_CASE("bake program: what cannot be written is told and leaves nothing") {
  const TemporaryFolder folder;
  const Ended ended = run_program(MANZANA_BAKE, folder.path(),
                                  {"plant", MANZANA_SPECIES "/shrub.json", "-o", folder.path() / "no" / "out.plant"});
  CHECK(ended.code == 1);
  CHECK_THAT(ended.err, Catch::Contains("out.plant: cannot be written"));
}

TEST_CASE("bake program: every broken model and L-system ends with 0 or 1 and one line") {
  for (const char* name : {"broken/gltf", "broken/treeparam"}) {
    const auto folder = data_file(name);
    if (!folder) return;
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
      if (entry.path().extension() == ".bin") continue;
      check_answer(entry.path());
      ++files;
    }
    CHECK(files >= 2);
  }
}

TEST_CASE("bake program: the plants of the book") {
  const auto file = data_file("treeparam/lsystems.json");
  if (!file) return;
  const TemporaryFolder folder;
  const Ended several = bake(folder.path(), *file);
  CHECK(several.code == 1);
  CHECK_THAT(several.err, Catch::Contains("holds several L-systems: choose one of abop-1.24a, "));
  for (const char* name : {"abop-1.24a", "abop-1.24c", "abop-1.24e", "abop-1.25-bush-3d", "abop-1.6-koch-island"}) {
    const Ended ended = bake(folder.path(), file->string() + "#" + name);
    CAPTURE(name, ended.err);
    CHECK(ended.code == 0);
    CHECK(manzana::foliage::read_prepared(folder.path() / "out.plant").name == name);
  }
}
