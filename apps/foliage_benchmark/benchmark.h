#pragma once
#include "apps/foliage_benchmark/options.h"

namespace manzana::foliage_benchmark {

/// Measures, and writes all files. Returns the exit code; throws std::runtime_error for what cannot be read or written.
int run_benchmark(const Options& options);

}  // namespace manzana::foliage_benchmark
