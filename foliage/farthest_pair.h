#pragma once
/// The two points of a cloud that are farthest apart: the line that stands for a branch of which nothing else is known.
/// [Gadbem 2011, section 3.4]
#include <cstdint>
#include <optional>
#include <span>

#include "culling/vec.h"

namespace manzana::foliage {

struct PointPair {
  std::uint32_t a = 0, b = 0;  ///< a < b
  bool operator==(const PointPair&) const = default;
};

/// Of equals the first (a, then b); nothing for less than two points. Exact in double while at most 2000 points can be
/// an end, which is so for all small and all long clouds; else of at least 0.95 of the length, by sweeps.
std::optional<PointPair> farthest_pair(std::span<const Vec3> points);

}  // namespace manzana::foliage
