#pragma once
/// VAMSplit R-tree: a static R-tree packed from the top like an optimised k-d tree; what Pina 2009 compares with.
/// [White, Jain: Similarity Indexing: Algorithms and Performance, SPIE 2670 (1996)]
///   VamTree tree = build_vam_tree(boxes, 16);
///   cull(tree, BoxPlanes(frustum, tree.origin, tree.reach), VamGrain::items, runs);
/// A set is split across the dimension in which the centres vary most, at that multiple of what a full subtree of the
/// next level holds that is nearest to the median. So all pages are full but the last of each level, and the tree needs
/// no pointers: an entry of a level bounds a run of the level below. Inner pages hold 16 entries, whatever a leaf page
/// holds: pages of one size, as the paper has them, if a leaf lists 16 boxes; 4 to 32 change a query by 5 %.
/// Scalar, with plane masks. Eight planes of a box at once made a query 1.3 to 1.45 times faster; bvh8 is the row that
/// shows what SIMD does for a tree of boxes.
#include <cstdint>
#include <vector>

#include "culling/baselines/box_planes.h"
#include "culling/bqr_tree.h"

namespace manzana::baselines {

inline constexpr std::uint32_t kVamFanout = 16;

struct VamTree {
  struct Level {
    std::vector<Corners> boxes;
    std::uint32_t entries = 0;  ///< that one of these bounds in the level below; the last may bound fewer
    std::uint32_t items = 0;    ///< the same of items
  };
  Vec3d origin{0, 0, 0};             ///< in L; all boxes are relative to it
  Vec3 reach{0, 0, 0};               ///< of all boxes
  std::vector<Level> levels;         ///< [0]: items, in the tree's order; [1]: leaf pages; back(): entries of the root
  std::vector<std::uint32_t> order;  ///< position -> index in the builder's input
};

/// `boxes` in L, finite and not empty; `page` items to a leaf page, at least 1. O(n log n).
VamTree build_vam_tree(std::span<const culling::BoxD> boxes, std::uint32_t page);

/// Of what a query reads: all but `order`.
std::size_t bytes(const VamTree& tree);

/// What is accepted or rejected in the end: single items, or leaf pages with all that they hold.
enum class VamGrain : std::uint8_t { items, pages };

/// `out` is cleared, and filled with rising runs of positions; neighbours are joined. An entry that is inside gives its
/// run untested. `planes` for the tree's origin and reach.
void cull(const VamTree& tree, const BoxPlanes& planes, VamGrain grain, std::vector<culling::ObjectRun>& out);

}  // namespace manzana::baselines
