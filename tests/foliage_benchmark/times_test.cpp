// Rows of tables that outlive an interrupted run.
#include <catch2/catch.hpp>

#include "apps/foliage_benchmark/times.h"
#include "gl/context.h"
#include "tests/support/temporary_folder.h"

namespace manzana::foliage_benchmark {

TEST_CASE("tables: what one run has measured the next one takes as it is") {
  const gl::HeadlessContext context;
  const TemporaryFolder folder;
  std::vector<std::string> measured;
  bool broken = true;
  const auto add = [&](Times& times) {
    for (const char* way : {"a", "b", "c"})
      times.add({.table = "t", .plant = "p", .way = way, .reference = "r"}, [&, way](TimeRow& row) {
        if (broken && *way == 'b') throw std::runtime_error("the power went");
        measured.emplace_back(way);
        row.cover = 0.5;
        row.primitives = 7;
      });
  };
  const Effort effort{true, folder.path()};
  CHECK_THROWS(measure_rows(effort, add));
  CHECK(measured == std::vector<std::string>{"a"});
  broken = false;
  const Times times = measure_rows(effort, add);
  CHECK(measured == std::vector<std::string>{"a", "b", "c"});
  REQUIRE(times.rows.size() == 3);
  for (const TimeRow& row : times.rows) {
    CHECK(row.cover == 0.5);
    CHECK(row.primitives == 7U);
    CHECK_FALSE(row.ms);
  }
  CHECK(times.dirty == 0);
  measure_rows({false, folder.path()}, add);  // in full: another measurement
  CHECK(measured.size() == 6);
}

}  // namespace manzana::foliage_benchmark
