#include "apps/foliage_benchmark/times.h"

#include <array>

#include "apps/common/progress_bar.h"

namespace manzana::foliage_benchmark {
namespace {

using C = apps::Column<TimeRow>;
const std::array kColumns{C{"table", "", "the source, and which of its tables", &TimeRow::table},
                          C{"plant", "", "", &TimeRow::plant},
                          C{"way", "", "what is measured", &TimeRow::way},
                          C{"reference", "", "what it is compared with", &TimeRow::reference},
                          C{"trees", "", "drawn or extracted", &TimeRow::trees},
                          C{"primitives", "", "triangles and points drawn", &TimeRow::primitives},
                          C{"reference_primitives", "", "by the reference", &TimeRow::reference_primitives},
                          C{"ms", "ms", "median", &TimeRow::ms},
                          C{"reference_ms", "ms", "median", &TimeRow::reference_ms},
                          C{"ratio", "", "median of reference_ms over ms of a pair", &TimeRow::ratio},
                          C{"ratio_lo", "", "of its 95 % interval, within one process", &TimeRow::ratio_lo},
                          C{"ratio_hi", "", "", &TimeRow::ratio_hi},
                          C{"pairs", "", "that were timed", &TimeRow::pairs},
                          C{"covered_px", "pixels", "that plants cover", &TimeRow::covered_px},
                          C{"cover", "", "over all detail's, finely sampled", &TimeRow::cover},
                          C{"ssim", "", "against all detail, finely sampled", &TimeRow::ssim},
                          C{"gmsd", "", "against all detail, finely sampled", &TimeRow::gmsd},
                          C{"source_value", "", "what stands in the source", &TimeRow::source_value}};

}  // namespace

std::span<const apps::Column<TimeRow>> time_columns() { return kColumns; }

void set_times(const PairTimes& times, TimeRow& row) {
  row.ms = times.ms;
  row.reference_ms = times.reference_ms;
  row.ratio = times.ratio;
  row.ratio_lo = times.ratio_lo;
  row.ratio_hi = times.ratio_hi;
  row.pairs = times.pairs;
}

Times measure_times(bool quick, std::span<const foliage::PreparedPlant> plants) {
  const Effort effort{quick};
  Times times;
  apps::ProgressBar bar(stderr);
  bar.show("Gumbau 2009", 0);
  add_gumbau(effort, times);
  bar.show("Deussen 2005", 0.25);
  add_deussen(effort, plants, times);
  bar.show("Gadbem 2011", 0.5);
  add_gadbem(effort, plants, times);
  bar.show("forests", 0.75);
  add_forests(effort, plants, times);
  bar.show("forests", 1);
  return times;
}

}  // namespace manzana::foliage_benchmark
