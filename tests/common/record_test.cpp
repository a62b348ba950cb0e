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
}
