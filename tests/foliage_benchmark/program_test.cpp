// The program from outside: exit codes, messages, files.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "apps/common/csv.h"
#include "tests/support/program.h"

using manzana::apps::split_cells;

namespace {

Ended run_benchmark(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  return run_program(MANZANA_FOLIAGE_BENCHMARK, folder, arguments);
}

std::vector<std::vector<std::string>> table_of(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> table;
  std::istringstream lines(read_all(file));
  for (std::string line; std::getline(lines, line);) table.push_back(split_cells(line));
  return table;
}

std::vector<std::string> small_run(const std::filesystem::path& folder, const std::filesystem::path& out) {
  std::ofstream(folder / "bush.json") << R"({"name":"bush","levels":2,"scale":2,"leaves":8,
    "stems":[{"branches":0,"curve_res":3},{"branches":6,"down_angle":60,"length":0.5,"curve_res":2}]})";
  return {"--out", out,       "--quick", "--errors-only", "--plants", folder / "bush.json", "--heights",
          "24",    "--views", "1"};
}

}  // namespace

TEST_CASE("foliage benchmark: help and version go to stdout and wrong usage is 2") {
  const TemporaryFolder folder;
  const Ended help = run_benchmark(folder.path(), {"--help"});
  CHECK(help.code == 0);
  CHECK(help.out.find("--plants") != std::string::npos);
  CHECK(help.err.empty());
  CHECK(run_benchmark(folder.path(), {"--version"}).out.starts_with("manzana-foliage-benchmark "));
  CHECK(run_benchmark(folder.path(), {"--quick"}).code == 2);
  CHECK(run_benchmark(folder.path(), {"--out", folder.path() / "o", "--heights", "0"}).code == 2);
}

TEST_CASE("foliage benchmark: a plant that is none is 1 and one line that names it") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "bad.glb") << "no plant";
  const Ended bad = run_benchmark(folder.path(), {"--out", folder.path() / "o", "--plants", folder.path() / "bad.glb"});
  CHECK(bad.code == 1);
  CHECK(bad.err.find("bad.glb") != std::string::npos);
  std::ofstream(folder.path() / "taken") << "";
  CHECK(run_benchmark(folder.path(), {"--out", folder.path() / "taken", "--quick"}).code == 1);
}

TEST_CASE("foliage benchmark: a small run writes whole tables and the same run again measures nothing") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const auto small = small_run(folder.path(), out);
  const Ended ended = run_benchmark(folder.path(), small);
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const auto runs = table_of(out / "runs.csv");
  REQUIRE(runs.size() == 1 + 3 + 2 * 2);
  for (const auto& row : runs) CHECK(row.size() == runs[0].size());
  CHECK(table_of(out / "summary.csv").size() == runs.size());
  const std::string report = read_all(out / "report.md");
  CHECK(report.find("| bush") != std::string::npos);
  CHECK(report.find("gumbau") != std::string::npos);
  CHECK(std::filesystem::exists(out / "columns.md"));
  CHECK(std::filesystem::exists(out / "sheet_bush.png"));
  CHECK(std::filesystem::exists(out / "popping_bush_error_64.png"));
  const std::string before = read_all(out / "runs.csv") + read_all(out / "popping.csv");
  REQUIRE(run_benchmark(folder.path(), small).code == 0);
  CHECK(read_all(out / "runs.csv") + read_all(out / "popping.csv") == before);  // dates too
}

TEST_CASE("foliage benchmark: an interrupted run keeps what it has and goes on from there") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  auto run = small_run(folder.path(), out);
  run.back() = "64";  // views
  const auto rows = [&] { return std::filesystem::exists(out / "runs.csv") ? table_of(out / "runs.csv").size() : 0; };
  const pid_t child = start_program(MANZANA_FOLIAGE_BENCHMARK, folder.path(), run);
  while (rows() < 15 && kill(child, 0) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(child, SIGINT);
  const Ended ended = wait_for(child, folder.path());
  CHECK(ended.code == 1);
  CHECK(ended.err.find("interrupted: the same command goes on") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(out / "summary.csv"));
  const auto before = table_of(out / "runs.csv");
  REQUIRE(before.size() < 1 + 64 * 7);
  REQUIRE(run_benchmark(folder.path(), run).code == 0);
  const auto after = table_of(out / "runs.csv");
  REQUIRE(after.size() == 1 + 64 * 7);
  for (std::size_t i = 0; i + 7 < before.size(); ++i) CHECK(after[i] == before[i]);  // the last picture may be half
}

TEST_CASE("foliage benchmark: the trade has a front whose rows stand in the summary and goes on where it was") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  auto run = small_run(folder.path(), out);
  *std::ranges::find(run, "--errors-only") = "--trade";
  run.back() = "2";  // views
  REQUIRE(run_benchmark(folder.path(), run).code == 0);
  const auto summary = table_of(out / "summary.csv"), front = table_of(out / "front.csv");
  REQUIRE(front.size() > 1);
  REQUIRE(front.size() < summary.size());
  for (const auto& row : front) CHECK(std::ranges::find(summary, row) != summary.end());
  CHECK(table_of(out / "quality.csv").size() == 4);
  CHECK(read_all(out / "report.md").find("## Speed for accuracy") != std::string::npos);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(front[0], name) - front[0].begin());
  };
  const auto of_grove = [&](const auto& row) { return row[0] == "wood, from afar" && row[column("groves")] == "10"; };
  CHECK(std::ranges::any_of(front, of_grove));
  std::size_t together = 0;
  for (const auto& row : std::span(front).subspan(1)) {
    if (row[0] != "all plants" && !row[0].starts_with("stand, ") && row[0] != "wood, from afar") continue;
    ++together;
    CHECK_FALSE(row[column("ratio")].empty());  // what each costs stands beside how wrong it is
  }
  CHECK(together > 3);
  const auto all = [&] {
    return read_all(out / "runs.csv") + read_all(out / "steps.csv") + read_all(out / "times.csv");
  };
  const std::string before = all();
  REQUIRE(run_benchmark(folder.path(), run).code == 0);
  CHECK(all() == before);  // dates too
}

TEST_CASE("foliage benchmark: a forest's frames are timed and judged and the same run again measures nothing") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  auto run = small_run(folder.path(), out);
  *std::ranges::find(run, "--errors-only") = "--forest";
  const Ended ended = run_benchmark(folder.path(), run);
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(table_of(out / "runs.csv").size() == 1 + 3 * 4);
  CHECK(table_of(out / "times.csv").size() == 1 + 3 + 1 + 2);
  CHECK(std::filesystem::exists(out / "frame_0.png"));
  for (const char* title : {"## A forest along a path", "## A forest from above"})
    CHECK(read_all(out / "report.md").find(title) != std::string::npos);
  const std::string before = read_all(out / "runs.csv") + read_all(out / "times.csv");
  REQUIRE(run_benchmark(folder.path(), run).code == 0);
  CHECK(read_all(out / "runs.csv") + read_all(out / "times.csv") == before);  // dates too
}

TEST_CASE("foliage benchmark: sheets alone") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  auto run = small_run(folder.path(), out);
  run.emplace_back("--sheets-only");
  REQUIRE(run_benchmark(folder.path(), run).code == 0);
  CHECK(std::filesystem::exists(out / "sheet_bush.png"));
  CHECK_FALSE(std::filesystem::exists(out / "report.md"));
}
