// The program from outside: exit codes, messages, files.
#include "tests/support/program.h"
#include "apps/common/csv.h"

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

TEST_CASE("foliage benchmark: a small run writes whole tables") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  std::ofstream(folder.path() / "bush.json") << R"({"name":"bush","levels":2,"scale":2,"leaves":8,
    "stems":[{"branches":0,"curve_res":3},{"branches":6,"down_angle":60,"length":0.5,"curve_res":2}]})";
  const Ended ended = run_benchmark(folder.path(), {"--out", out, "--quick", "--errors-only", "--plants",
                                                    folder.path() / "bush.json", "--heights", "24", "--views", "1"});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const auto runs = table_of(out / "runs.csv");
  REQUIRE(runs.size() == 1 + 2 + 2 * 2);
  for (const auto& row : runs) CHECK(row.size() == runs[0].size());
  CHECK(table_of(out / "summary.csv").size() == runs.size());
  const std::string report = read_all(out / "report.md");
  CHECK(report.find("| bush") != std::string::npos);
  CHECK(report.find("gumbau") != std::string::npos);
  CHECK(std::filesystem::exists(out / "columns.md"));
  CHECK(std::filesystem::exists(out / "sheet_bush.png"));
}
