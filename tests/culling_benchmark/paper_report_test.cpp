#include <catch2/catch.hpp>
#include <set>

#include "apps/culling_benchmark/paper_plots.h"
#include "apps/culling_benchmark/paper_record.h"
#include "apps/culling_benchmark/paper_text.h"

namespace manzana::paper {
namespace {

/// A run that nobody measured: every structure has its own time and triangles, a part's times are all multiplied alike,
/// and those of the second part once more for the BqR-Tree.
PaperRun made_up(int frames = 12, int parts = 3) {
  PaperRun run = unmeasured(paper_lanes(), {.frames = frames, .parts = parts});
  run.renderer = "made up";
  for (LaneCosts& costs : run.lanes) {
    const bool bqr = costs.lane.peer == "bqr-paper", none = costs.lane.peer == "none";
    const double ms = none ? 100 : bqr ? 30 : 50;
    costs.city_triangles = costs.lane.city == "C1" ? 100 : 400;
    for (std::size_t i = 0; i < costs.frames.size(); ++i) {
      const int part = static_cast<int>(i) % parts;
      const double slow = (1 + part) * (bqr && part == 1 ? 1.5 : 1);
      costs.frames[i] = {true,     0.1 * ms * slow, 0.2 * ms * slow, 0.7 * ms * slow, none ? 1000U : bqr ? 300U : 600U,
                         part == 2};
    }
  }
  run.parts_done = parts;
  return run;
}

std::vector<PaperRow> rows_of(const std::vector<PaperRow>& rows, const std::string& table, const std::string& peer,
                              const std::string& quantity) {
  std::vector<PaperRow> found;
  for (const PaperRow& row : rows)
    if (row.paper_table == table && row.peer == peer && row.quantity == quantity) found.push_back(row);
  return found;
}

std::size_t measured(const PaperRun& run) {
  std::size_t count = 0;
  for (const LaneCosts& lane : run.lanes)
    for (const FrameCost& frame : lane.frames) count += frame.measured ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("a row has the mean of the frames, and the median of the parts' ratios") {
  const auto rows = paper_rows(made_up());
  const PaperRow row = rows_of(rows, "1", "bqr-paper", "frame_ms").at(0);
  CHECK(row.value == Approx(30 * (1 + 2 * 1.5 + 3) / 3));
  CHECK(row.query_ms.value() == Approx(0.1 * row.value));
  CHECK(row.submit_ms.value() == Approx(0.2 * row.value));
  CHECK(row.draw_ms.value() == Approx(0.7 * row.value));
  CHECK(row.ratio_to == "no structure");
  CHECK(row.reference.value() == Approx(200));
  CHECK(row.ratio.value() == Approx(0.3));  // of 0.3, 0.45, 0.3
  CHECK(row.ratio_lo.value() == Approx(0.3));
  CHECK(row.ratio_hi.value() == Approx(0.45));
  CHECK(row.paper_value.value() == Approx(48.3));
  CHECK(row.paper_ratio.value() == Approx(0.261).epsilon(1e-3));
  CHECK(row.frames == 12);
  CHECK(row.parts == 3);
  CHECK(row.dirty == 1);
}

TEST_CASE("counts have no interval, and the paper's stand beside them") {
  const auto rows = paper_rows(made_up());
  const PaperRow none = rows_of(rows, "1", "none", "triangles").at(0);
  CHECK(none.value == 1000);
  CHECK(none.paper_value.value() == 1'688'023);
  const PaperRow bqr = rows_of(rows, "1", "bqr-paper", "triangles").at(0);
  CHECK(bqr.ratio.value() == Approx(0.3));
  CHECK(!bqr.ratio_lo);
  CHECK(bqr.paper_ratio.value() == Approx(0.2493).epsilon(1e-3));
}

TEST_CASE("all tables have rows, and what was not measured has none") {
  std::set<std::string> tables;
  for (const PaperRow& row : paper_rows(made_up())) tables.insert(row.paper_table);
  CHECK(tables == std::set<std::string>{"1", "2", "3", "8", "9", "text"});
  PaperRun little = made_up();
  std::erase_if(little.lanes,
                [](const LaneCosts& lane) { return lane.lane.city != "C2" || !lane.lane.levels.empty(); });
  tables.clear();
  for (const PaperRow& row : paper_rows(little)) tables.insert(row.paper_table);
  CHECK(tables == std::set<std::string>{"1", "2"});
  CHECK(paper_rows(unmeasured({}, {})).empty());
}

TEST_CASE("the file has a head, and a line a row with as many cells") {
  const auto rows = paper_rows(made_up());
  const std::string text = to_csv(rows);
  CHECK(text.starts_with("paper_table,paper_row,quantity,case,peer,"));
  CHECK(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) == rows.size() + 1);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    CHECK(apps::split_cells(std::string_view(text).substr(at, end - at)).size() == paper_columns().size());
    at = end + 1;
  }
}

TEST_CASE("a run is restored from its record, and only from that of the same measurement") {
  const PaperRun run = made_up();
  const std::string text = record(run, "commit, machine");
  PaperRun again = unmeasured(paper_lanes(), run.options);
  restore(again, text, "commit, machine");
  CHECK(again.parts_done == 3);
  CHECK(again.renderer == "made up");
  CHECK(record(again, "commit, machine") == text);
  CHECK(to_csv(paper_rows(again)) == to_csv(paper_rows(run)));

  PaperRun other = unmeasured(paper_lanes(), run.options);
  restore(other, text, "another commit");
  CHECK(measured(other) == 0);
  PaperOptions options = run.options;
  options.seed = 2;
  other = unmeasured(paper_lanes(), options);
  restore(other, text, "commit, machine");
  CHECK(measured(other) == 0);
  other = unmeasured(paper_lanes(), run.options);
  other.renderer = "another device";
  restore(other, text, "commit, machine");
  CHECK(measured(other) == 0);
}

TEST_CASE("a record that ends in the middle restores the parts that are whole") {
  PaperRun run = made_up();
  for (LaneCosts& lane : run.lanes) lane.frames[1].measured = false;  // of the second part
  PaperRun again = unmeasured(paper_lanes(), run.options);
  restore(again, record(run, "x"), "x");
  CHECK(again.parts_done == 1);
  const std::string text = record(made_up(), "x");
  again = unmeasured(paper_lanes(), run.options);
  restore(again, std::string_view(text).substr(0, text.size() / 2), "x");
  CHECK(again.parts_done == 0);
  CHECK(measured(again) > 100);
  restore(again, "no,such,columns\n\n\"", "x");
}

TEST_CASE("the text has every table, and says so when the grain alone makes the difference") {
  const PaperRun run = made_up();
  GrainTable grains;
  for (GrainCounts& counts : grains) counts = {1000, 300, {300, 350, 400, 450, 480, 505, 600, 700}};
  const std::vector<std::string> plots{"path_C2", "paper_fig5"};
  const std::string text = paper_text(run, paper_rows(run), grains, plots);
  using Catch::Matchers::Contains;
  for (const char* part : {"## Pina 2009", "Table 1", "Table 2", "Table 3", "figure 9", "made up", "640 x 360",
                           "During 1 of the parts", "at the same grain there is none",
                           "no more than the paper's with 12", "7.6 times", "15 %", "30 %", "](paper_fig5.svg)"})
    CHECK_THAT(text, Contains(part));
  CHECK_THAT(text, !Contains("nan") && !Contains("inf "));
  for (GrainCounts& counts : grains) counts.vam[0] = 600;
  CHECK_THAT(paper_text(run, paper_rows(run), grains, plots), !Contains("at the same grain there is none"));
}

TEST_CASE("page after page of blocks sends more triangles, and none more than no structure") {
  const GrainTable grains = count_grains(20, 1);
  for (const GrainCounts& counts : grains) {
    CHECK(counts.bqr > 0);
    for (const std::uint64_t vam : counts.vam) CHECK(vam <= counts.none);
    CHECK(counts.vam[0] <= counts.vam[2]);
    CHECK(counts.vam[2] <= counts.vam[7]);
    CHECK(counts.vam[7] > counts.bqr);
  }
  CHECK(grains[0].none == 20 * 367'000ULL);
  CHECK(grains[1].none == 20 * 1'688'023ULL);
}

TEST_CASE("plots hold a line of data for each frame, city and number of cars") {
  const auto plots = paper_plots(made_up());
  REQUIRE(plots.size() == 4);
  const auto lines = [](const std::string& script) {
    const std::size_t begin = script.find("<< END\n") + 7, end = script.find("\nEND", begin) + 1;
    return std::count(script.begin() + static_cast<std::ptrdiff_t>(begin),
                      script.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  };
  CHECK(lines(plots[0].text) == 12);
  CHECK(lines(plots[1].text) == 12);
  CHECK(lines(plots[2].text) == 6);
  CHECK(lines(plots[3].text) == 3);
  CHECK(paper_plots(unmeasured({}, {})).empty());
}

}  // namespace manzana::paper
