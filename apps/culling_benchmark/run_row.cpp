#include "apps/culling_benchmark/run_row.h"

#include <array>
#include <sstream>
#include <tuple>

namespace manzana::culling_benchmark {
namespace {

using C = apps::Column<RunRow>;
using R = RunRow;

const std::array kColumns{
    C{"commit", "", "what the program was built from; -dirty and a hash: with changes", &R::commit},
    C{"date", "UTC", "when the row was finished", &R::date},
    C{"machine", "", "processor and number of cores", &R::machine},
    C{"mode", "", "quick or full", &R::mode},
    C{"scene", "", "generated, or size and time of change of the city file", &R::scene},
    C{"case", "", "city, far plane, caches", &R::case_name},
    C{"peer", "", "the structure", &R::peer},
    C{"grain", "", "what it decides about: object or block", &R::grain},
    C{"seed", "", "of the city and of the order of measurement", &R::seed},
    C{"process", "", "which process of the run", &R::process},
    C{"objects", "", "in the city", &R::objects},
    C{"blocks", "", "in the city", &R::blocks},
    C{"frames", "", "of the flight; all counts are sums over them", &R::frames},
    C{"timed_frames", "", "of these, timed in each round; fewer are spread over the ranks of their costs",
      &R::timed_frames},
    C{"pairs", "", "rounds of this structure, each beside a round of bqr", &R::pairs},
    C{"build_ms", "ms", "to build the structure", &R::build_ms},
    C{"median_us", "us", "of a query: median over the timed frames, then over the rounds", &R::median_us},
    C{"bqr_us", "us", "the same of bqr in the rounds beside", &R::bqr_us},
    C{"ratio_to_bqr", "", "median over the pairs of this structure's round over bqr's", &R::ratio},
    C{"ratio_lo", "", "holds the median ratio of this process with 95 %, by rank: lower end", &R::ratio_lo},
    C{"ratio_hi", "", "upper end", &R::ratio_hi},
    C{"accepted", "objects", "in the answers", &R::accepted},
    C{"exact", "objects", "whose box meets the view, by separating axes", &R::exact},
    C{"missed", "objects", "of these, not in the answers; must be 0", &R::missed},
    C{"triangles", "", "of accepted objects", &R::triangles},
    C{"bytes", "", "of the structure with all bounds that it reads", &R::bytes},
    C{"dirty", "", "1: the machine was disturbed in every attempt", &R::dirty},
    C{"attempts", "", "how often it was measured; the last counts", &R::attempts},
    C{"calibration_ms", "ms", "a loop of fixed work, the slower of before and after", &R::calibration_ms},
    C{"others_cores", "cores", "taken by other programs meanwhile", &R::others_cores},
    C{"steal", "", "share of processor time taken by other guests of the host", &R::steal},
};

}  // namespace

std::span<const apps::Column<RunRow>> run_columns() { return kColumns; }

bool same_measurement(const RunRow& a, const RunRow& b) {
  const auto key = [](const RunRow& r) {
    return std::tie(r.commit, r.machine, r.mode, r.scene, r.case_name, r.peer, r.seed, r.process, r.frames);
  };
  return key(a) == key(b);
}

std::string to_csv(std::span<const RunRow> rows) {
  std::string csv = apps::head_line(run_columns());
  for (const RunRow& row : rows) csv += apps::to_line(row, run_columns());
  return csv;
}

std::vector<RunRow> read_rows(std::string_view csv) {
  std::vector<RunRow> rows;
  std::istringstream lines{std::string(csv)};
  for (std::string line; std::getline(lines, line);)
    if (auto row = apps::from_line(line, run_columns())) rows.push_back(*std::move(row));
  return rows;
}

}  // namespace manzana::culling_benchmark
