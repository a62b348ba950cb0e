#include <catch2/catch.hpp>

#include "apps/culling_benchmark/frame_table.h"
#include "apps/culling_benchmark/run_row.h"
#include "apps/culling_benchmark/summary.h"

using namespace manzana::culling_benchmark;

namespace {

RunRow full_row() {
  RunRow row;
  row.commit = "abc";
  row.machine = "Some \"Processor\", 2 cores";
  row.case_name = "a,b.osm";
  row.peer = "bqr";
  row.triangles = 12345678901234567890ULL;
  row.median_us = 0.001234567;
  row.steal = 0;
  return row;
}

}  // namespace

TEST_CASE("runs.csv: what is written is read again, quotes and commas too") {
  const std::vector<RunRow> rows{full_row(), RunRow{}};
  const auto back = read_rows(to_csv(rows));
  REQUIRE(back.size() == 2);
  CHECK(back[0].machine == rows[0].machine);
  CHECK(back[0].case_name == rows[0].case_name);
  CHECK(back[0].triangles == rows[0].triangles);
  CHECK(back[0].median_us == Approx(rows[0].median_us).epsilon(1e-5));
  CHECK(to_csv(back) == to_csv(rows));
  CHECK(same_measurement(back[0], rows[0]));
}

TEST_CASE("runs.csv: a half line, another head, rubbish are no rows") {
  const std::string csv = to_csv(std::vector<RunRow>{full_row()});
  CHECK(read_rows("").empty());
  CHECK(read_rows(csv.substr(0, csv.size() - 20)).empty());
  CHECK(read_rows("a,b,c\n1,2,3\n").empty());
  std::string letters = csv;
  letters.replace(letters.find("12345678901234567890"), 3, "xyz");
  CHECK(read_rows(letters).empty());
  CHECK(read_rows("rubbish\n" + csv).size() == 1);
}

TEST_CASE("runs.csv: a row stands for another only if all that decides about it is equal") {
  const RunRow row = full_row();
  const auto differs = [&](auto change) {
    RunRow other = row;
    change(other);
    return !same_measurement(row, other);
  };
  CHECK(differs([](RunRow& r) { r.commit = "abd"; }));
  CHECK(differs([](RunRow& r) { r.machine += "x"; }));
  CHECK(differs([](RunRow& r) { r.mode = "quick"; }));
  CHECK(differs([](RunRow& r) { r.scene = "7@7"; }));
  CHECK(differs([](RunRow& r) { r.case_name = "C1"; }));
  CHECK(differs([](RunRow& r) { r.peer = "none"; }));
  CHECK(differs([](RunRow& r) { r.seed = 2; }));
  CHECK(differs([](RunRow& r) { r.process = 2; }));
  CHECK(differs([](RunRow& r) { r.frames = 2; }));
  CHECK_FALSE(differs([](RunRow& r) { r.median_us = 2; }));
}

TEST_CASE("summary.csv: begins with the columns that were agreed, and leaves cells empty that were not measured") {
  SummaryRow row;
  row.case_name = "C2";
  row.peer = "osg";
  row.grain = "object";
  const std::string csv = to_csv(std::vector<SummaryRow>{row});
  CHECK(csv.starts_with("case,peer,median_us,ratio_to_bqr,accepted,exact,missed,triangles,build_ms,bytes,grain,"));
  CHECK(csv.find("\nC2,osg,,,,,,,,,object,,,") != std::string::npos);
}

TEST_CASE("columns.md: names every column with what it is") {
  const std::string text = manzana::apps::explain(run_columns()) + manzana::apps::explain(summary_columns()) +
                           manzana::apps::explain(frame_columns());
  for (const char* name : {"ratio_to_bqr", "grain", "timed_frames", "steal", "exact", "us"})
    CHECK(text.find(std::string("| ") + name + " |") != std::string::npos);
  CHECK(text.find("|  |  |") == std::string::npos);
}

TEST_CASE("frames: times stand at the frames that were timed, the others are empty") {
  const std::vector<Counts> counts{{5, 4, 0, 50, 0}, {6, 6, 0, 60, 0}, {7, 7, 0, 70, 0}};
  const auto rows = frame_table(counts, {{1}, 9}, {{}, {}, {2.5}});
  CHECK(to_csv(rows) == "frame,us,accepted,exact,triangles\n0,,5,4,50\n1,2.5,6,6,60\n2,,7,7,70\n");
}
