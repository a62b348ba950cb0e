#pragma once
/// The adaptive quadtree over the centres of blocks that shapes the BqR-Tree.  [Pina 2009, 3.1; numerics 4]
/// Halved at the middle; a centre on the border belongs to the upper side; empty quadrants make no node, chains of
/// single children are collapsed. One block a leaf; blocks with equal centres (or beyond the last depth) share a
/// quadrant and become siblings under its node. nodes[0] is the root, a node's descendants follow it, its leaves are
/// one run.
#include <cstdint>
#include <span>
#include <vector>

#include "culling/bqr_tree.h"

namespace manzana::culling {

struct QuadNode {
  std::uint32_t first = 0, last = 0;  ///< leaves
  std::uint32_t skip = 0;             ///< index of the first node after this one's descendants
  std::uint32_t depth = 0;            ///< of its quadrant; the root's is 0
  /// Unique: a 1, then two bits (y, x) for each quadrant on the way from the root. Leaves that share their last
  /// quadrant have no way of their own: their key is 2^63 + the leaf's index (no way reaches that bit: 31 quadrants at
  /// most).
  std::uint64_t key = 0;
  bool leaf() const { return last - first == 1; }
};

struct Quadtree {
  std::vector<QuadNode> nodes;
  std::vector<std::uint32_t> order;  ///< order[leaf] = index of the block
};

/// Of blocks with finite centres and volumes. O(n log n) for spread centres, O(31 n) at worst. Does not depend on the
/// order of the input: blocks that share their last quadrant are ordered by their coordinates. A quadrant is not split
/// when all centres in it are equal, at depth 31, or where doubles end.
Quadtree build_quadtree(std::span<const BlockVolume> blocks);

}  // namespace manzana::culling
