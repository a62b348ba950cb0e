#include "foliage/import/load_plant.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "files/whole_file.h"
#include "foliage/generate.h"
#include "foliage/import/plant_cache.h"
#include "foliage/import/species.h"
#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

using namespace manzana::foliage;
namespace fs = std::filesystem;

namespace {

const char* const kTwo =
    R"({"a": {"axiom": "F[+F~L]", "angle": 30, "n": 0}, "b": {"axiom": "FF~L", "angle": 30, "n": 0}})";

std::string complaint(const PlantSource& source) {
  try {
    load_plant(source);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::vector<fs::path> plants_in(const fs::path& folder) {
  std::vector<fs::path> found;
  if (!fs::exists(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".plant") found.push_back(entry.path());
  return found;
}

}  // namespace

TEST_CASE("plants from files: the kind is told by the ending and the content") {
  const TemporaryFolder folder;
  const auto file = [&](const char* name, const std::string& text) {
    manzana::files::write_whole(folder.path() / name, text);
    return folder.path() / name;
  };
  const fs::path two = file("two.json", kTwo), species = file("bush.json", R"({"name": "bush", "levels": 1})");
  CHECK(load_plant({two, "b"}).plant.name == "b");
  CHECK(load_plant({species}).plant.name == "bush");
  CHECK(load_plant({file("leaf.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}).plant.name == "leaf");
  CHECK_THAT(complaint({two}), Catch::EndsWith("two.json: holds several L-systems: choose one of a, b"));
  CHECK_THAT(complaint({two, "c"}), Catch::EndsWith("two.json: has no L-system c, but a, b"));
  CHECK_THAT(complaint({species, "c"}), Catch::EndsWith("bush.json: holds no L-systems"));
  CHECK_THAT(complaint({file("deep.json", std::string(100'000, '['))}), Catch::Contains("deep.json: "));
  CHECK_THAT(complaint({file("plant.txt", "")}), Catch::Contains("plant.txt: is no file of a kind"));
  CHECK_THAT(complaint({folder.path() / "none.json"}), Catch::EndsWith("none.json: no such file"));
  CHECK_THAT(complaint({folder.path() / "none.obj"}), Catch::EndsWith("none.obj: no such file"));
}

TEST_CASE("plants from files: the L-system's name follows a hash") {
  CHECK(parse_plant_source("a.json").system.empty());
  CHECK(parse_plant_source("a.json#b").file == "a.json");
  CHECK(parse_plant_source("a.json#b").system == "b");
  const TemporaryFolder folder;
  const std::string whole = (folder.path() / "a#b.json").string();
  manzana::files::write_whole(whole, "{}");
  CHECK(parse_plant_source(whole).file == whole);
}

TEST_CASE("plants are kept prepared, by content and options") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "two.json", cache = folder.path() / "cache" / "deep";
  manzana::files::write_whole(file, kTwo);
  std::vector<std::string> lines;
  const auto tell = [&](const std::string& line) { lines.push_back(line); };
  const auto load = [&](const std::string& system, const PrepareOptions& options = {}) {
    return encoded(load_or_prepare({file, system}, cache, options, tell));
  };
  const std::string first = load("a");
  REQUIRE(plants_in(cache).size() == 1);
  const fs::path kept = plants_in(cache)[0];
  const auto written = fs::last_write_time(kept);
  CHECK(load("a") == first);
  CHECK(fs::last_write_time(kept) == written);
  load("b");
  PrepareOptions other;
  other.seed = 9;
  load("a", other);
  CHECK(plants_in(cache).size() == 3);
  other = {};
  other.branch_order = BranchOrder::length;
  load("a", other);
  CHECK(plants_in(cache).size() == 4);
  manzana::files::write_whole(file, std::string(kTwo) + " ");
  load("a");
  CHECK(plants_in(cache).size() == 5);
  CHECK(lines.empty());
}

TEST_CASE("built-in species are kept prepared, by name and seed") {
  const TemporaryFolder folder;
  const fs::path cache = folder.path() / "cache";
  const auto grow = [&](std::string_view name, std::uint64_t seed) {
    return encoded(grow_or_prepare(name, seed, cache, {.visibility_side = 0}, [](const std::string&) { FAIL(); }));
  };
  const std::string first = grow("shrub", 3);
  REQUIRE(plants_in(cache).size() == 1);
  const auto written = fs::last_write_time(plants_in(cache)[0]);
  CHECK(grow("shrub", 3) == first);
  CHECK(fs::last_write_time(plants_in(cache)[0]) == written);
  CHECK(first == encoded(prepare(grow_plant(builtin_species("shrub"), 3), {.visibility_side = 0})));
  CHECK(grow("shrub", 4) != first);
  CHECK(grow("palm", 3) != first);
  CHECK(plants_in(cache).size() == 3);
}

TEST_CASE("plants that are kept damaged are made again, with one line that says so") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "two.json", cache = folder.path() / "cache";
  manzana::files::write_whole(file, kTwo);
  std::vector<std::string> lines;
  const auto load = [&] {
    lines.clear();
    return encoded(load_or_prepare({file, "a"}, cache, {}, [&](const std::string& line) { lines.push_back(line); }));
  };
  const std::string first = load();
  const fs::path kept = plants_in(cache)[0];
  for (const std::string& bad : {std::string(), first.substr(0, first.size() / 2), first + "x", std::string("oak")}) {
    manzana::files::write_whole(kept, bad);
    CHECK(load() == first);
    REQUIRE(lines.size() == 1);
    CHECK_THAT(lines[0], Catch::StartsWith(kept.string()) && Catch::EndsWith("; made again"));
    CHECK(load() == first);
    CHECK(lines.empty());
  }
}

TEST_CASE("plants that cannot be kept are still prepared") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "two.json";
  manzana::files::write_whole(file, kTwo);
  std::vector<std::string> lines;
  const auto tell = [&](const std::string& line) { lines.push_back(line); };
  const PreparedPlant plant = load_or_prepare({file, "a"}, file / "below", {}, tell);
  CHECK(plant.name == "a");
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Catch::EndsWith("; the plant is not kept"));
  CHECK(load_or_prepare({file, "a"}, std::nullopt, {}, tell).name == "a");
  CHECK(lines.size() == 1);
}

TEST_CASE("plants are made again when a file changes that they refer to") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "leaf.obj", library = folder.path() / "leaf.mtl";
  manzana::files::write_whole(file, "mtllib leaf.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl leaf\nf 1 2 3\n");
  std::vector<std::string> lines;
  const auto colour = [&] {
    lines.clear();
    const auto tell = [&](const std::string& line) { lines.push_back(line); };
    return load_or_prepare({file}, folder.path() / "cache", {}, tell).leaf_image.rgba[0];
  };
  CHECK(colour() == 255);
  CHECK(lines.size() == 1);  // the library is absent
  manzana::files::write_whole(library, "newmtl leaf\nKd 0 1 0\n");
  CHECK(colour() == 0);
  CHECK(lines.empty());
  manzana::files::write_whole(library, "newmtl leaf\nKd 1 1 0\n");
  CHECK(colour() == 255);
  CHECK(colour() == 255);
  CHECK(plants_in(folder.path() / "cache").size() == 3);
}

TEST_CASE("plants are kept where the system keeps what can be made again") {
  const auto with = [](const char* cache, const char* home) {
    cache != nullptr ? setenv("XDG_CACHE_HOME", cache, 1) : unsetenv("XDG_CACHE_HOME");
    home != nullptr ? setenv("HOME", home, 1) : unsetenv("HOME");
    return default_cache_folder();
  };
  const char* before = std::getenv("HOME");
  const std::string home = before == nullptr ? "" : before;
  CHECK(with("/var/c", "/home/a") == fs::path("/var/c/manzana"));
  CHECK(with("relative", "/home/a") == fs::path("/home/a/.cache/manzana"));
  CHECK(with(nullptr, "/home/a") == fs::path("/home/a/.cache/manzana"));
  CHECK_FALSE(with(nullptr, nullptr));
  with(nullptr, home.empty() ? nullptr : home.c_str());
}
