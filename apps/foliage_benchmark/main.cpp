// manzana-foliage-benchmark: what plants cost and how true they look, by each source's way and by ours.
// SHOWS: prepare, make_details, select, extract, draw_plants. READ FIRST: stage.h, then errors.h.
#include "apps/foliage_benchmark/benchmark.h"

int main(int argc, char** argv) {
  using namespace manzana;
  const foliage_benchmark::Parsed parsed = foliage_benchmark::parse_options(argc, argv);
  if (!parsed.options) return apps::reply(parsed);
  return apps::guarded("manzana-foliage-benchmark", "the plants",
                       [&] { return foliage_benchmark::run_benchmark(*parsed.options); });
}
