// Rows that outlive an interrupted run.
#include <catch2/catch.hpp>

#include "apps/common/record.h"
#include "apps/common/run_facts.h"
#include "tests/support/temporary_folder.h"

using namespace manzana::apps;

namespace {

struct Row : RunFacts, Calm {
  std::string name;
};

std::span<const Column<Row>> columns() {
  static const auto all =
      joined<Row>({run_columns<Row>(), {Column<Row>{"name", "", "", &Row::name}}, calm_columns<Row>()});
  return all;
}

Row row_of(const std::string& name, const std::string& mode = "full") {
  Row row;
  static_cast<RunFacts&>(row) = run_facts(mode);
  row.name = name;
  return row;
}

}  // namespace

TEST_CASE("record: what one run has kept the next one has and what is of another mode is dropped") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "runs.csv";
  const auto open = [&](const std::string& mode) {
    return Record<Row>(file, columns(), [mode](const Row& row) { return same_run(row, run_facts(mode)); });
  };
  auto first = open("full");
  CHECK(first.rows().empty());
  first.keep(row_of("a"));
  first.keep(row_of("b"));
  first.keep(row_of("c", "quick"));
  const auto again = open("full");
  REQUIRE(again.rows().size() == 2);
  CHECK(again.rows()[1].name == "b");
  CHECK(again.find([](const Row& row) { return row.name == "a"; }) != nullptr);
  CHECK(again.find([](const Row& row) { return row.name == "c"; }) == nullptr);
  CHECK(open("quick").rows().size() == 1);
}

TEST_CASE("record: a line that was cut short is passed over") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "runs.csv";
  Record<Row>(file, columns(), [](const Row&) { return true; }).keep(row_of("a"));
  std::ofstream(file, std::ios::app) << "half,a,li";
  CHECK(Record<Row>(file, columns(), [](const Row&) { return true; }).rows().size() == 1);
  Row row = row_of("c");
  row.calibration_ms = 12.5;
  const std::string line = to_line(row, columns());
  std::ofstream(file) << head_line(columns()) << line.substr(0, line.size() - 2);  // all cells are there, the last cut
  CHECK(Record<Row>(file, columns(), [](const Row&) { return true; }).rows().empty());
}

TEST_CASE("record: a row more is a line more and what is dropped goes with the next row") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "runs.csv";
  const auto open = [&] { return Record<Row>(file, columns(), [](const Row&) { return true; }); };
  auto record = open();
  std::string text = head_line(columns());
  for (const char* name : {"a", "b", "c"}) {
    record.keep(row_of(name));
    text += to_line(record.rows().back(), columns());
    CHECK(read_all(file) == text);
  }
  record.drop([](const Row& row) { return row.name == "b"; });
  record.keep(row_of("d"));
  CHECK(read_all(file) == to_csv<Row>(record.rows(), columns()));
  const auto again = open();
  CHECK(again.rows().size() == 3);
}

TEST_CASE("record: a file that cannot be written any more is said") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "of" / "runs.csv";
  std::filesystem::create_directory(file.parent_path());
  Record<Row> record(file, columns(), [](const Row&) { return true; });
  record.keep(row_of("a"));
  std::filesystem::remove_all(file.parent_path());
  CHECK_THROWS_WITH(record.keep(row_of("b")), Catch::Contains("runs.csv"));
}
