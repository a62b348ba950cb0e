#pragma once
#include "apps/foliage_benchmark/times.h"

namespace manzana::foliage_benchmark {

/// The rows of one of the sources' tables; columns without a value in any row are left out.
std::string rows_md(std::span<const TimeRow> rows, std::string_view table);

}  // namespace manzana::foliage_benchmark
