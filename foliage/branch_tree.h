#pragma once
/// Weighted-tree pruning: a tree taken apart into paths, the heaviest first, so that the first paths are the best small
/// tree.  [Gadbem 2011, section 3.4.1]
///   TreePaths paths = heaviest_paths(parents, weights);
///   paths.order                          // nodes; every prefix is a tree: parents come before their children
///   paths.order[paths.ends[i] - 1]       // the tip of path i
/// A node's weight is what is not yet taken of it and below it. A path goes from the root to the heaviest child, and
/// on; those of its nodes that are not yet taken are one level of detail of the paper's.
#include <cstdint>
#include <span>
#include <vector>

namespace manzana::foliage {

struct TreePaths {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> ends;  ///< path i is order[ends[i - 1], ends[i])
};

/// A node's parent is before it, or -1: of several roots the heaviest comes first, as among children. `weights`: each
/// node's own, in whole numbers, so that equals are equals: of those the first goes first. Their sum must not overflow.
/// No recursion. Cost: the lengths of all ways from the root to the ends of paths, times the logarithm of the siblings.
TreePaths heaviest_paths(std::span<const std::int32_t> parents, std::span<const std::uint64_t> weights);

}  // namespace manzana::foliage
