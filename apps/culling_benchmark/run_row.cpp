#include "apps/culling_benchmark/run_row.h"

#include <tuple>

namespace manzana::culling_benchmark {
namespace {

using C = apps::Column<RunRow>;
using R = RunRow;

const std::vector<C> kOwnColumns{
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
};

}  // namespace

std::span<const C> run_columns() {
  static const auto columns = apps::joined<R>({apps::run_columns<R>(), kOwnColumns, apps::calm_columns<R>()});
  return columns;
}

bool same_measurement(const RunRow& a, const RunRow& b) {
  const auto key = [](const RunRow& r) { return std::tie(r.scene, r.case_name, r.peer, r.seed, r.process, r.frames); };
  return same_run(a, b) && key(a) == key(b);
}

std::string to_csv(std::span<const RunRow> rows) { return apps::to_csv<RunRow>(rows, run_columns()); }

std::vector<RunRow> read_rows(std::string_view csv) { return apps::rows_of(csv, run_columns()); }

}  // namespace manzana::culling_benchmark
