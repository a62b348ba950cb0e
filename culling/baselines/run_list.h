#pragma once
/// Lists of runs, built from the front.
#include "culling/object_table.h"

namespace manzana::baselines {

/// Joined with the last run where it follows on from it.
inline void append(std::vector<culling::ObjectRun>& runs, std::uint32_t first, std::uint32_t last) {
  if (!runs.empty() && runs.back().last == first)
    runs.back().last = last;
  else
    runs.push_back({first, last});
}

}  // namespace manzana::baselines
