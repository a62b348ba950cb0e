#pragma once
/// BqR-Tree: an R-tree shaped by an adaptive quadtree over the centres of city blocks.
/// [Pina, Cerezo, Seron: Bq-Rtree (2009), section 3; called Pina 2009]
///   BqrTree tree = build_bqr_tree(blocks);             // once; store the blocks by tree.order
///   cull(tree, frustum, [&](LeafRun run) { ... });     // each frame
/// A block goes whole to the quadrant of its centre; empty quadrants make no node; chains of single children are
/// collapsed. Inner nodes are bounded by spheres, made bottom-up over the leaves below them; a leaf is the intersection
/// of a sphere and a box. One block a leaf, so leaf i is the i-th block in the tree's order; blocks with equal centres
/// (or beyond the last depth) become siblings under one node.
/// nodes[0] is the root, a node's descendants follow it, the leaves of a node are one run.
#include <cstdint>
#include <span>
#include <vector>

#include "culling/frustum_lanes.h"
#include "culling/overlap.h"

namespace manzana::culling {

/// What the tree must know of a block: metres, in L. `box` and `sphere` enclose all of its content (including its
/// half-streets and the cars on them); `center` is the geometric centre of its ground, which decides the quadrant.
struct BlockVolume {
  Vec2d center{0, 0};
  BoxD box;
  SphereD sphere;
};

/// Half-open run of leaves, and whether all of it is certainly inside. Bit k of `planes`: it may reach beyond plane k.
struct LeafRun {
  std::uint32_t first = 0, last = 0;
  Overlap where = Overlap::crosses;
  std::uint8_t planes = 0xFF;
};

struct BqrNode {
  Sphere bounds;            ///< relative to the tree's origin; encloses all content below
  std::uint32_t first = 0;  ///< leaves [first, last)
  std::uint32_t last = 0;
  std::uint32_t skip = 0;   ///< index of the first node after this one's descendants
  std::uint32_t depth = 0;  ///< of its quadrant; the root's is 0
  /// Unique: a 1, then two bits (y, x) for each quadrant on the way from the root. Leaves that share their last
  /// quadrant have no way of their own: their key is 2^63 + the leaf's index (no way reaches that bit: 31 quadrants at
  /// most).
  std::uint64_t key = 0;
  bool leaf() const { return last - first == 1; }
};

struct BqrTree {
  Vec3d origin{0, 0, 0};             ///< in L; all float volumes are relative to it
  std::vector<BqrNode> nodes;        ///< depth first
  std::vector<Box> leaf_boxes;       ///< one a leaf
  std::vector<std::uint32_t> order;  ///< order[leaf] = index of the block in the builder's input
};

/// O(n log n) for spread centres, O(31 n) at worst. No block: no node; one: the root is its leaf. The tree does not
/// depend on the order of the input (blocks that share their last quadrant are ordered by their coordinates). `origin`
/// is the centre of all content in whole metres. A quadrant is not split when all centres in it are equal, at depth 31,
/// or where doubles end. Throws std::invalid_argument, with the index of the block, for a centre or volume that is
/// empty or not finite, or a volume that reaches beyond 1e37 m (the end of float).
BqrTree build_bqr_tree(std::span<const BlockVolume> blocks);

struct CullStats {
  std::uint32_t nodes_tested = 0, leaves_tested = 0;
};

/// Calls emit(LeafRun) for each maximal part of the tree that is not outside; runs come in rising order and are
/// disjoint. A node that is inside emits its whole run untested. No allocation.
template <class Emit>
CullStats cull(const BqrTree& tree, const Frustum& frustum, Emit&& emit) {
  CullStats stats;
  const FrustumLanes planes(frustum);
  const auto end = static_cast<std::uint32_t>(tree.nodes.size());
  for (std::uint32_t i = 0; i < end;) {
    const BqrNode& node = tree.nodes[i];
    const Sides at = node.leaf() ? sides(planes, node.bounds, tree.leaf_boxes[node.first]) : sides(planes, node.bounds);
    const Overlap where = to_overlap(at);
    ++(node.leaf() ? stats.leaves_tested : stats.nodes_tested);
    const bool descend = where == Overlap::crosses && !node.leaf();
    if (!descend && where != Overlap::outside)
      emit(LeafRun{node.first, node.last, where, static_cast<std::uint8_t>(~at.inside)});
    i = descend ? i + 1 : node.skip;
  }
  return stats;
}

}  // namespace manzana::culling
