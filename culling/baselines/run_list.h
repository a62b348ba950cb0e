#pragma once
/// Lists of runs, built from the front.
#include <bit>

#include "culling/bqr_tree.h"

namespace manzana::baselines {

/// Joined with the last run where it follows on from it.
inline void append(std::vector<culling::ObjectRun>& runs, std::uint32_t first, std::uint32_t last) {
  if (!runs.empty() && runs.back().last == first)
    runs.back().last = last;
  else
    runs.push_back({first, last});
}

/// A position for each bit, `first` for the lowest.
inline void append_bits(std::vector<culling::ObjectRun>& runs, std::uint32_t first, std::uint32_t bits) {
  while (bits != 0) {
    const int skip = std::countr_zero(bits), length = std::countr_one(bits >> skip);
    append(runs, first + static_cast<std::uint32_t>(skip), first + static_cast<std::uint32_t>(skip + length));
    bits &= bits + (bits & -bits);  // without its lowest run of ones
  }
}

}  // namespace manzana::baselines
