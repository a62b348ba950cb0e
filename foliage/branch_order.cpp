#include "foliage/branch_order.h"

#include <algorithm>
#include <numeric>

#include "foliage/branch_tree.h"

namespace manzana::foliage {
namespace {

double measure(const BranchShape& shape, BranchOrder by) {
  switch (by) {
    case BranchOrder::count:
      return 1;
    case BranchOrder::length:
      return static_cast<double>(shape.length_m);
    case BranchOrder::area:
      return static_cast<double>(shape.area_m2);
    case BranchOrder::visible_area:
      return static_cast<double>(shape.area_m2) * static_cast<double>(shape.visibility);
    case BranchOrder::width:
      break;
  }
  return static_cast<double>(shape.width_m);
}

/// In whole numbers, of 2^52 in all: sums are exact, so equal branches stay equal.
std::vector<std::uint64_t> weights_of(std::span<const BranchShape> shapes, BranchOrder by) {
  double sum = 0;
  for (const BranchShape& shape : shapes) sum += measure(shape, by);
  const double unit = sum > 0 ? 0x1p52 / sum : 0;
  std::vector<std::uint64_t> weights;
  for (const BranchShape& shape : shapes) weights.push_back(static_cast<std::uint64_t>(measure(shape, by) * unit));
  return weights;
}

std::vector<std::uint32_t> thickest_first(std::span<const BranchShape> shapes) {
  std::vector<std::uint32_t> order(shapes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return shapes[a].width_m > shapes[b].width_m; });
  return order;
}

}  // namespace

std::vector<std::uint32_t> importance_order(const Plant& plant, std::span<const BranchShape> shapes, BranchOrder by) {
  if (by == BranchOrder::width) return thickest_first(shapes);
  std::vector<std::int32_t> parents;
  for (const Branch& branch : plant.branches) parents.push_back(branch.parent);
  return heaviest_paths(parents, weights_of(shapes, by)).order;
}

}  // namespace manzana::foliage
