// manzana-culling-benchmark: what the BqR-Tree and its rivals take and find, in cities that are generated or read.
// SHOWS: peers(), exactly_overlaps, interleaved timing. READ FIRST: measure.cpp, then timing.cpp.
#include "apps/culling_benchmark/benchmark.h"

int main(int argc, char** argv) {
  using namespace manzana;
  using namespace manzana::culling_benchmark;
  const Parsed parsed = parse_options(argc, argv);
  if (!parsed.options) return apps::reply(parsed);
  return apps::guarded("manzana-culling-benchmark", "the cases", [&] {
    return run_benchmark(*parsed.options, {argv + 1, argv + argc});
  });
}
