#pragma once
/// The whole program behind its command line.
#include "apps/culling_benchmark/options.h"

namespace manzana::culling_benchmark {

/// Measures what is not measured yet, and writes all files into options.out, each whole or not at all. Returns 1 when a
/// structure missed an object, else 0. `arguments`: those of this program, for its processes. Throws
/// std::runtime_error.
int run_benchmark(const Options& options, const std::vector<std::string>& arguments);

}  // namespace manzana::culling_benchmark
