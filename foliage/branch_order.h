#pragma once
/// Branches from the most important to the least.
#include <span>

#include "foliage/branch_shape.h"
#include "foliage/prepare.h"

namespace manzana::foliage {

/// Rows of plant.branches. Shapes are those of its branches. Equals stay in the plant's order.
std::vector<std::uint32_t> importance_order(const Plant& plant, std::span<const BranchShape> shapes, BranchOrder by);

}  // namespace manzana::foliage
