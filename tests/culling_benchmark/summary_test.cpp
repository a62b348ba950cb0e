#include "apps/culling_benchmark/summary.h"

#include <catch2/catch.hpp>

#include "apps/culling_benchmark/report_goals.h"

using namespace manzana;
using namespace manzana::culling_benchmark;

namespace {

RunRow row_of(const char* peer, std::uint64_t process, double us, double ratio) {
  RunRow row;
  row.case_name = "C2";
  row.peer = peer;
  row.process = process;
  row.frames = 10;
  row.timed_frames = 10;
  row.pairs = 50 + process;
  row.median_us = us;
  row.ratio = ratio;
  row.ratio_lo = ratio * 0.9;
  row.ratio_hi = ratio * 1.1;
  row.accepted = 101;
  row.exact = 100;
  row.calibration_ms = 5;
  return row;
}

Options options_of(std::vector<std::string> peers) {
  Options options;
  options.cases = {"C2"};
  options.peers = std::move(peers);
  return options;
}

}  // namespace

TEST_CASE("summary: the median of the processes, and their range") {
  std::vector<RunRow> rows;
  for (std::uint64_t p = 1; p <= 6; ++p)
    rows.push_back(row_of("linear", p, static_cast<double>(p), static_cast<double>(p * p)));
  const auto table = summarise(options_of({"linear"}), rows);
  REQUIRE(table.size() == 2);  // bqr is always asked for
  CHECK(table[1].median_us == 3.5);
  CHECK(*table[1].ratio == Approx(12));  // between 9 and 16, as logarithms
  CHECK(table[1].ratio_lo == 1);
  CHECK(table[1].ratio_hi == 36);
  CHECK(table[1].processes == 6);
  CHECK(table[1].pairs == 51);
  CHECK(table[1].dirty == 0);
  CHECK(table[1].accepted == 101);
}

TEST_CASE("summary: of one process its own interval") {
  const auto table = summarise(options_of({"linear"}), std::vector{row_of("linear", 1, 7, 2)});
  CHECK(*table[1].ratio_lo == Approx(1.8));
  CHECK(*table[1].ratio_hi == Approx(2.2));
}

TEST_CASE("summary: disturbed processes do not count while others do, and are told") {
  std::vector<RunRow> rows{row_of("linear", 1, 7, 2), row_of("linear", 2, 9, 3), row_of("linear", 3, 8, 4)};
  rows[1].dirty = 1;
  rows[2].calibration_ms = 6;  // the machine has shown that it can do better
  const auto table = summarise(options_of({"linear"}), rows);
  CHECK(table[1].median_us == 7);
  CHECK(table[1].processes == 1);
  CHECK(table[1].dirty == 2);
  rows[0].dirty = 1;
  const auto all_dirty = summarise(options_of({"linear"}), rows);
  CHECK(all_dirty[1].median_us == 8);
  CHECK(all_dirty[1].processes == 3);
  CHECK(all_dirty[1].dirty == 3);
}

TEST_CASE("summary: the time of bqr is the median beside all that it was measured with") {
  std::vector<RunRow> rows{row_of("bqr", 1, 7, 1), row_of("linear", 1, 9, 3), row_of("linear", 2, 8, 4)};
  for (std::size_t i = 0; i < 3; ++i) rows[i].bqr_us = static_cast<double>(2 + i * i);
  CHECK(summarise(options_of({"bqr", "linear"}), rows)[0].median_us == 3);
  rows[2].dirty = 1;
  CHECK(summarise(options_of({"bqr", "linear"}), rows)[0].median_us == 2.5);
}

TEST_CASE("summary: a structure without a row has empty cells, never zeros") {
  const auto table = summarise(options_of({"bqr", "linear"}), std::vector{row_of("bqr", 1, 7, 1)});
  REQUIRE(table.size() == 2);
  CHECK(table[0].measured());
  CHECK_FALSE(table[1].measured());
  CHECK_FALSE(table[1].missed);
  CHECK(table[1].grain == "object");
}

TEST_CASE("faults: a missed object, and an answer that changed, each told once") {
  std::vector<RunRow> rows{row_of("linear", 1, 7, 2), row_of("linear", 2, 7, 2)};
  CHECK(faults(rows).empty());
  rows[1].accepted = 102;
  CHECK(faults(rows) == std::vector<std::string>{"linear on C2 answered otherwise in process 2"});
  for (RunRow& row : rows) row.accepted = 99, row.missed = 2;
  CHECK(faults(rows) == std::vector<std::string>{"linear on C2 MISSED 2 of 100 objects"});
}

TEST_CASE("goals: met, not met, and doubtful are told apart") {
  SummaryRow bqr, linear;
  bqr.case_name = linear.case_name = "C2";
  bqr.peer = "bqr";
  linear.peer = "linear-simd";
  for (SummaryRow* s : {&bqr, &linear}) {
    s->median_us = s->ratio = s->ratio_lo = s->ratio_hi = 1;
    s->accepted = s->exact = 100;
    s->missed = 0;
  }
  const auto text = [&](double lo, double ratio, double hi) {
    linear.ratio_lo = lo;
    linear.ratio = ratio;
    linear.ratio_hi = hi;
    return goals_text(std::vector{bqr, linear});
  };
  CHECK(text(5, 6, 7).find("| <= 0.250 | 0.167 [0.143, 0.200] | met |") != std::string::npos);
  CHECK(text(2, 2.5, 3).find("**not met** |") != std::string::npos);
  CHECK(text(3, 5, 6).find("met, but not by all of the interval |") != std::string::npos);
  CHECK(goals_text(std::vector{bqr}).empty());
}
