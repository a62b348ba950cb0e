// The program from outside: exit codes, messages, files.
#include <stb_image.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scenegraph/draw/renderer.h"
#include "scenegraph/import/baked_city.h"
#include "tests/support/data.h"
#include "tests/support/program.h"

namespace {

Ended run_walkthrough(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  return run_program(MANZANA_WALKTHROUGH, folder, arguments);
}

using Json = nlohmann::json;
using Path = std::filesystem::path;

std::vector<std::string> small_run(const Path& out, const std::string& city, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{city,     "--headless", "--frames",   "6",      "--every", "3",      "--size",
                                     "160x90", "--out",      out.string(), "--path", "pina",    "--cars", "300"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// The columns of frames.csv that count, without those that measure.
std::string counts_of(const std::string& csv) {
  std::string counts;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::size_t comma = 0;
    for (int i = 0; i < 4; ++i) comma = line.find(',', comma) + 1;
    counts += line.substr(comma) + "\n";
  }
  return counts;
}

/// Standard deviation of the grey values.
double contrast(const Path& png) {
  int width = 0, height = 0, channels = 0;
  unsigned char* pixels = stbi_load(png.c_str(), &width, &height, &channels, 1);
  REQUIRE(pixels != nullptr);
  double sum = 0, squares = 0;
  for (int i = 0; i < width * height; ++i) sum += pixels[i], squares += static_cast<double>(pixels[i]) * pixels[i];
  stbi_image_free(pixels);
  const double n = static_cast<double>(width) * height;
  return std::sqrt(squares / n - sum / n * sum / n);
}

}  // namespace

TEST_CASE("program: the town to pictures, counts and a summary, the same again for one seed, other for another") {
  const TemporaryFolder folder;
  const Path a = folder.path() / "a", b = folder.path() / "b", c = folder.path() / "c";
  const Ended first = run_walkthrough(folder.path(), small_run(a, "builtin:town"));
  CAPTURE(first.err);
  REQUIRE(first.code == 0);
  CHECK(first.memory_mb < 1024 * kLarger);
  REQUIRE(std::filesystem::exists(a / "frame_0000.png"));
  REQUIRE(std::filesystem::exists(a / "frame_0003.png"));
  CHECK(std::distance(std::filesystem::directory_iterator(a), {}) == 5);
  CHECK(contrast(a / "frame_0000.png") > 5);
  CHECK(contrast(a / "frame_0003.png") > 5);
  const std::string csv = read_all(a / "frames.csv");
  CHECK(lines_in(csv) == 7);
  CHECK(
      csv.starts_with("frame,cull_us,update_us,draw_ms,blocks_visible,buildings_visible,trees_visible,cars_visible,"
                      "triangles,points,tree_error_px\n0,"));
  const Json summary = Json::parse(read_all(a / "summary.json"));
  CHECK(summary["blocks"] >= 150);
  CHECK(summary["buildings"] >= 3000);
  CHECK(summary["trees"] >= 5000);
  CHECK(summary["cars"] == 300);
  CHECK(summary["structure"] == "bqr");
  CHECK(summary["median"]["triangles"] > 100);
  CHECK(summary["median"]["draw_ms"] > 0);
  CHECK(summary["import_s"] > 0);
  CHECK_FALSE(summary["renderer"].get<std::string>().empty());

  REQUIRE(run_walkthrough(folder.path(), small_run(b, "builtin:town")).code == 0);
  CHECK(counts_of(read_all(b / "frames.csv")) == counts_of(csv));
  for (const char* name : {"frame_0000.png", "frame_0003.png"}) CHECK(read_all(a / name) == read_all(b / name));

  REQUIRE(run_walkthrough(folder.path(), small_run(c, "builtin:town", {"--seed", "2"})).code == 0);
  CHECK(counts_of(read_all(c / "frames.csv")) != counts_of(csv));
}

TEST_CASE("program: without the structure the same picture, from everything that there is") {
  const TemporaryFolder folder;
  const Path tree = folder.path() / "tree", none = folder.path() / "none";
  REQUIRE(run_walkthrough(folder.path(), small_run(tree, "builtin:town")).code == 0);
  REQUIRE(run_walkthrough(folder.path(), small_run(none, "builtin:town", {"--structure", "none"})).code == 0);
  const Json with = Json::parse(read_all(tree / "summary.json")),
             without = Json::parse(read_all(none / "summary.json"));
  CHECK(without["structure"] == "none");
  CHECK(without["median"]["buildings_visible"] == without["buildings"]);
  CHECK(without["median"]["trees_visible"] == without["trees"]);
  CHECK(without["median"]["cars_visible"] == without["cars"]);
  CHECK(with["median"]["buildings_visible"] < without["median"]["buildings_visible"]);
  CHECK(with["median"]["triangles"] < without["median"]["triangles"]);
}

TEST_CASE("program: an ecosystem is walked through like a city") {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments{MANZANA_MEADOW, "--headless",
                                           "--frames",     "6",
                                           "--every",      "3",
                                           "--size",       "160x90",
                                           "--out",        (folder.path() / "out").string()};
  const Ended ended = run_walkthrough(folder.path(), arguments);
  REQUIRE(ended.code == 0);
  CHECK(ended.out.find("2900 trees") != std::string::npos);
  const Json summary = Json::parse(read_all(folder.path() / "out" / "summary.json"));
  CHECK(summary["median"]["trees_visible"] > 500);
  CHECK(contrast(folder.path() / "out" / "frame_0000.png") > 25);
}

TEST_CASE("program: the error in trees is what was asked for, and a law without room says so") {
  const TemporaryFolder folder;
  const auto errors_of = [&](std::vector<std::string> more) {
    const Ended ended =
        run_walkthrough(folder.path(), small_run(folder.path() / "out", "builtin:town", std::move(more)));
    REQUIRE(ended.code == 0);
    std::istringstream lines(read_all(folder.path() / "out" / "frames.csv"));
    std::string line;
    std::getline(lines, line);
    std::vector<double> errors;
    while (std::getline(lines, line)) errors.push_back(std::stod(line.substr(line.rfind(',') + 1)));
    return std::pair(errors, ended.err);
  };
  for (const double error : errors_of({"--tree-error", "3"}).first) CHECK(error == 3);
  for (const double error : errors_of({"--quality", "accurate"}).first)
    CHECK(error == manzana::draw::quality_named("accurate").tree_error_px);
  const auto [errors, said] = errors_of({"--tree-law", "gadbem"});
  CHECK(said.find("no room for what gadbem shows") != std::string::npos);
}

TEST_CASE("program: memory is reported and what it has no room for is told") {
  const TemporaryFolder folder;
  const auto run = [&](const char* name, std::vector<std::string> more) {
    more.insert(more.end(), {"--report-memory", "--no-wind"});
    const Ended ended =
        run_walkthrough(folder.path(), small_run(folder.path() / name, "builtin:town", std::move(more)));
    REQUIRE(ended.code == 0);
    return ended;
  };
  const Ended all = run("all", {});
  CHECK(all.out.find("meshes of buildings and surfaces") != std::string::npos);
  CHECK(std::stod(all.out.substr(all.out.find("over_model: device ") + 19)) <= 1.5);
  const Ended none = run("none", {"--gpu-mb", "1"});
  CHECK(none.err.find("no room for all meshes in view") != std::string::npos);
}

TEST_CASE("program: a baked city with little room for meshes gives the pictures of the imported one") {
  const TemporaryFolder folder;
  const Path baked = folder.path() / "town.manzana";
  manzana::write_baked(baked, manzana::import_city("builtin:town", {.cars = 300}, {}));
  const auto run = [&](const char* name, const std::string& city, std::vector<std::string> more) {
    more.insert(more.end(), {"--report-memory", "--no-wind", "--no-packs"});
    const Ended ended = run_walkthrough(folder.path(), small_run(folder.path() / name, city, std::move(more)));
    REQUIRE(ended.code == 0);
    return ended;
  };
  const auto device_mb = [](const std::string& report, const std::string& part) {
    double sum = 0;
    std::istringstream lines(report);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("  device  " + part)) sum += std::stod(line.substr(44));
    return sum;
  };
  const Ended all = run("all", "builtin:town", {});
  const double meshes = device_mb(all.out, "meshes");
  const double little = device_mb(all.out, "") - meshes / 3;
  const Ended some = run("some", baked, {"--gpu-mb", std::to_string(little)});
  CHECK(some.out.find("meshes, in the file alone") != std::string::npos);
  CHECK(some.err.find("no room") == std::string::npos);
  CHECK(device_mb(some.out, "meshes") < 0.8 * meshes);
  for (const char* frame : {"frame_0000.png", "frame_0003.png"})
    CHECK(read_all(folder.path() / "all" / frame) == read_all(folder.path() / "some" / frame));
}

TEST_CASE("program: a day of driving leaves counts and memory as they were") {
  const TemporaryFolder folder;
  // Address sanitizer, where it is, keeps what was freed for a while: that is no drift.
  const Ended day =
      run_program("/usr/bin/env", folder.path(),
                  {"ASAN_OPTIONS=quarantine_size_mb=0:thread_local_quarantine_size_kb=0", MANZANA_WALKTHROUGH,
                   "builtin:town", "--headless", "--hours", "24", "--frames", "60", "--every", "60", "--size", "160x90",
                   "--path", "pina", "--cars", "300", "--no-packs", "--out", folder.path() / "out"});
  CAPTURE(day.err, day.out);
  CHECK(day.code == 0);
  CHECK(day.out.find(" 24.0      ") != std::string::npos);
}

TEST_CASE("program: no display and no --headless goes headless and says so") {
  const TemporaryFolder folder;
  auto arguments = small_run(folder.path() / "out", "builtin:town", {"--frames", "1"});
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--headless"));
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--frames"),
                  std::find(arguments.begin(), arguments.end(), "--every"));
  const Ended ended = run_walkthrough(folder.path(), arguments);
  CAPTURE(ended.err);
  CHECK(ended.code == 0);
  CHECK(ended.err.starts_with("no display"));
  CHECK(std::filesystem::exists(folder.path() / "out" / "frames.csv"));
}

TEST_CASE("program: help and version go to stdout, wrong usage is 2") {
  const TemporaryFolder folder;
  const Ended help = run_walkthrough(folder.path(), {"--help"});
  CHECK(help.code == 0);
  CHECK(help.out.find("--structure") != std::string::npos);
  CHECK(help.err.empty());
  CHECK(run_walkthrough(folder.path(), {"--version"}).out.starts_with("manzana-walkthrough "));
  const Ended wrong = run_walkthrough(folder.path(), {"--nonsense"});
  CHECK(wrong.code == 2);
  CHECK(lines_in(wrong.err) == 1);
  CHECK(wrong.out.empty());
}

TEST_CASE("program: bad input is 1 and one line that names the file") {
  const TemporaryFolder folder;
  const Path bad = folder.path() / "bad.json";
  std::ofstream(bad) << R"({"keys": [{"t": 0, "eye": [0, 0], "look": [0, 1, 0]}]})";
  std::ofstream(folder.path() / "bad.glb") << "no glTF";
  std::ofstream(folder.path() / "city.txt") << "no city";
  std::ofstream(folder.path() / "taken") << "";
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<Case> cases{
      {{folder.path() / "missing.osm"}, "missing.osm: "},
      {{folder.path() / "missing.osm.pbf"}, "missing.osm.pbf: "},
      {{folder.path() / "city.txt"}, "city.txt: "},
      {{folder.path()}, folder.path().string() + ": "},
      {{"builtin:village"}, "builtin:village: "},
      {{folder.path() / "bad.json"}, "bad.json: "},
      {{folder.path() / "missing.json"}, "missing.json: "},
      {{"--path", bad}, "bad.json: keys[0].eye: three numbers are needed"},
      {{"--path", "nowhere"}, "nowhere: no such camera path"},
      {{"--plant", "shrub=" + (folder.path() / "bad.glb").string()}, "bad.glb: "},
      {{"--orthophoto", folder.path() / "none.tif"}, "none.tif: "},
      {{folder.path() / "x.manzana", "--terrain", folder.path() / "x.tif"},
       "x.manzana: a baked city stands on its ground"},
      {{"--add", folder.path() / "y.manzana"}, "y.manzana: no such file"},
      {{"--out", folder.path() / "taken"}, "taken: "},
  };
  for (const Case& c : cases) {
    auto arguments = c.arguments;
    arguments.push_back("--headless");
    if (c.says != "taken: ") arguments.insert(arguments.end(), {"--out", folder.path() / "out"});
    const Ended ended = run_walkthrough(folder.path(), arguments);
    CAPTURE(c.says, ended.err);
    CHECK(ended.code == 1);
    CHECK(ended.err.starts_with("manzana-walkthrough: "));
    CHECK(ended.err.find(c.says) != std::string::npos);
    CHECK(lines_in(ended.err) == 1);
  }
}

TEST_CASE("program: every broken OpenStreetMap file ends with 0 or 1 within 5 s and 500 MB") {
  const auto broken = data_file("broken/osm");
  if (!broken) return;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*broken)) {
    const TemporaryFolder folder;
    const Path out = folder.path() / "out";
    const Ended ended = run_walkthrough(
        folder.path(), {entry.path(), "--headless", "--frames", "2", "--every", "2", "--size", "64x36", "--out", out});
    CAPTURE(entry.path().filename(), ended.err, ended.cpu_s, ended.memory_mb);
    CHECK((ended.code == 0 || ended.code == 1));
    CHECK(ended.cpu_s < 5 * kSlower);  // of all threads together, so that a busy machine does not count
    CHECK(ended.memory_mb < 500 * kLarger);
    const std::string last = ended.err.substr(ended.err.rfind('\n', ended.err.size() - 2) + 1);
    if (ended.code == 1) CHECK(last.starts_with("manzana-walkthrough: " + entry.path().string() + ": "));
    if (ended.code == 0) {
      const Json summary = Json::parse(read_all(out / "summary.json"));
      CHECK(summary["issues"] == lines_in(read_all(out / "issues.txt")));
    }
    ++files;
  }
  CHECK(files > 15);
}

TEST_CASE("program: real data carry their attribution") {
  const auto file = data_file("tiny/helsinki-block.osm.pbf");
  if (!file) return;
  const TemporaryFolder folder;
  const Ended ended = run_walkthrough(folder.path(), small_run(folder.path() / "out", file->string()));
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(ended.out.find("\u00a9 OpenStreetMap contributors") != std::string::npos);
  const Json summary = Json::parse(read_all(folder.path() / "out" / "summary.json"));
  CHECK(summary["attribution"].get<std::string>().find("\u00a9 OpenStreetMap contributors") != std::string::npos);
}
