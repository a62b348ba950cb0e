#pragma once
/// Objects brought into the order in which a structure keeps their blocks, so that a run of blocks is one of objects.
#include "culling/baselines/city.h"

namespace manzana::baselines {

struct BlockRows {
  std::vector<std::uint32_t> rows;  ///< position -> row of City::boxes
  std::vector<std::uint32_t> first{
      0};  ///< blocks + 1: positions of the order's i-th block are [first[i], first[i + 1])
};

BlockRows rows_of(const City& city, std::span<const std::uint32_t> block_order);

/// City::boxes at these rows.
std::vector<culling::BoxD> boxes_of(const City& city, std::span<const std::uint32_t> rows);

}  // namespace manzana::baselines
