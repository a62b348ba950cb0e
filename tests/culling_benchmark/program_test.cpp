// The program from outside: exit codes, messages, files, and whether its figures agree with each other.
#include <algorithm>

#include "apps/common/csv.h"
#include "apps/culling_benchmark/run_row.h"
#include "tests/support/program.h"

using namespace manzana::culling_benchmark;

namespace {

Ended run_benchmark(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  return run_program(MANZANA_CULLING_BENCHMARK, folder, arguments);
}

using Table = std::vector<std::vector<std::string>>;
Table table_of(const std::filesystem::path& file) {
  Table table;
  std::istringstream lines(read_all(file));
  for (std::string line; std::getline(lines, line);) table.push_back(manzana::apps::split_cells(line));
  return table;
}

double number(const Table& table, std::size_t row, const std::string& column) {
  const auto at = std::find(table[0].begin(), table[0].end(), column) - table[0].begin();
  return std::stod(table.at(row).at(static_cast<std::size_t>(at)));
}

}  // namespace

TEST_CASE("benchmark: help, version and the list go to stdout, wrong usage is 2") {
  const TemporaryFolder folder;
  const Ended help = run_benchmark(folder.path(), {"--help"});
  CHECK(help.code == 0);
  CHECK(help.out.find("--quick") != std::string::npos);
  CHECK(help.err.empty());
  CHECK(run_benchmark(folder.path(), {"--version"}).out.starts_with("manzana-culling-benchmark "));
  CHECK(run_benchmark(folder.path(), {"--list"}).out.find("100k-cold") != std::string::npos);
  CHECK(run_benchmark(folder.path(), {"--quick"}).code == 2);
  CHECK(run_benchmark(folder.path(), {"--out", folder.path(), "--peers", "oak"}).code == 2);
}

TEST_CASE("benchmark: bad input is 1 and one line that names it") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "taken") << "";
  const Ended nowhere = run_benchmark(folder.path(), {"--out", folder.path() / "out", "--case", "C1,nowhere.osm"});
  CHECK(nowhere.code == 1);
  CHECK(nowhere.err == "manzana-culling-benchmark: nowhere.osm: no such case (see --list), nor a file\n");
  CHECK(run_benchmark(folder.path(), {"--out", folder.path() / "taken", "--case", "C1"}).code == 1);
  std::ofstream(folder.path() / "bad.osm") << "no city";
  const Ended bad = run_benchmark(folder.path(), {"--out", folder.path() / "out", "--case", folder.path() / "bad.osm"});
  CHECK(bad.code == 1);
  CHECK(bad.err.find("bad.osm: ") != std::string::npos);
}

TEST_CASE("benchmark: a small quick run writes whole tables whose figures agree") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const Ended ended = run_benchmark(
      folder.path(), {"--out", out, "--quick", "--case", "C1", "--peers", "bqr,none,linear", "--frames", "8"});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const Table summary = table_of(out / "summary.csv");
  REQUIRE(summary.size() == 4);
  for (std::size_t row = 1; row < summary.size(); ++row) {
    CAPTURE(summary[row]);
    CHECK(number(summary, row, "missed") == 0);
    CHECK(number(summary, row, "accepted") >= number(summary, row, "exact"));
    CHECK(number(summary, row, "exact") == number(summary, 1, "exact"));
    CHECK(number(summary, row, "pairs") >= 9);
    CHECK(number(summary, row, "frames") == 8);
    CHECK(number(summary, row, "ratio_lo") <= number(summary, row, "ratio_to_bqr"));
    CHECK(number(summary, row, "ratio_hi") >= number(summary, row, "ratio_to_bqr"));
  }
  CHECK(summary[1][1] == "bqr");
  CHECK(summary[2][1] == "none");
  CHECK(number(summary, 2, "accepted") == 8 * number(summary, 2, "objects"));
  CHECK(number(summary, 2, "triangles") == 8 * 367000);
  CHECK(number(summary, 3, "ratio_to_bqr") > number(summary, 2, "ratio_to_bqr"));

  const auto rows = read_rows(read_all(out / "runs.csv"));
  REQUIRE(rows.size() == 3);
  const Table frames = table_of(out / "frames" / "C1_linear.csv");
  REQUIRE(frames.size() == 9);
  double accepted = 0;
  for (std::size_t row = 1; row < frames.size(); ++row) accepted += number(frames, row, "accepted");
  CHECK(accepted == number(summary, 3, "accepted"));

  const std::string report = read_all(out / "report.md");
  CHECK(report.find("No object was missed: 24 answers were checked") != std::string::npos);
  CHECK(report.find("## C1") != std::string::npos);
  CHECK(read_all(out / "columns.md").find("ratio_to_bqr") != std::string::npos);
  CHECK(std::filesystem::exists(out / "plots" / "path_C1.gp"));
}

TEST_CASE("benchmark: a full run has its six processes, and the same answers in each") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const Ended ended =
      run_benchmark(folder.path(), {"--out", out, "--case", "C1", "--peers", "bqr", "--frames", "3", "--seed", "5"});
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const auto rows = read_rows(read_all(out / "runs.csv"));
  REQUIRE(rows.size() == 6);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i].process == i + 1);
    CHECK(rows[i].seed == 5);
    CHECK(rows[i].pairs >= 50);
    CHECK(rows[i].exact == rows[0].exact);
    CHECK(rows[i].accepted == rows[0].accepted);
  }
  const Table summary = table_of(out / "summary.csv");
  CHECK(number(summary, 1, "processes") + number(summary, 1, "dirty") >= 6);
}
