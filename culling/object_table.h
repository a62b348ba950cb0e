#pragma once
/// Objects (buildings, trees, ground pieces) in block order, so that a run of blocks is a run of objects.
///   ObjectTable table = build_object_table(tree, boxes_by_block_order, first);
///   std::vector<ObjectRun> runs; reserve_runs(runs, table);                    // once
///   cull_objects(table, block_runs, frustum, runs);                            // each frame, no allocation
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "culling/bqr_tree.h"

namespace manzana::culling {

/// Half-open run of objects.
struct ObjectRun {
  std::uint32_t first = 0, last = 0;
};

/// The boxes of eight neighbours in columns: min x, y, z, then max x, y, z. Three cache lines in a row, because a query
/// comes to them cold: after a frame has been drawn, fetching costs more than testing.
struct alignas(64) ObjectPacket {
  std::array<std::array<float, 8>, 6> columns{};
};

/// Objects of block b (the tree's leaf b) are [first[b], first[b+1]). Bounds are relative to the tree's origin,
/// outward.
struct ObjectTable {
  std::vector<std::uint32_t> first;   ///< leaves + 1
  std::vector<ObjectPacket> packets;  ///< object i is lane i % 8 of packet i / 8
  /// No coordinate is larger than its axis' reach, metres: one rounding margin for the whole table. Infinite, nothing
  /// is ever culled.
  Vec3 reach{std::numeric_limits<float>::infinity()};
  std::uint32_t size() const { return first.empty() ? 0 : first.back(); }
  Box box(std::uint32_t i) const;
};

/// `boxes` in block order, in L; `first` has a row a leaf and one more. Throws std::invalid_argument for a box that is
/// empty or not finite (with its index).
ObjectTable build_object_table(const Vec3d& origin, std::span<const BoxD> boxes, std::vector<std::uint32_t> first);

/// Asks the processor for what cull_objects will read of a run that crosses. Answers nothing; for queries that have
/// other work to do in between.
void prefetch(const ObjectTable& table, const LeafRun& run);

/// Room for any answer.
void reserve_runs(std::vector<ObjectRun>& runs, const ObjectTable& table);

/// `out` is cleared, and filled with the disjoint, rising runs of the objects that are not outside.
/// Blocks that are inside give their objects untested; those that cross are tested one by one, box against frustum.
/// Allocates nothing when out.capacity() >= table.size().
void cull_objects(const ObjectTable& table, std::span<const LeafRun> blocks, const Frustum& frustum,
                  std::vector<ObjectRun>& out);

/// Without a structure: one run with everything.
void take_all(const ObjectTable& table, std::vector<ObjectRun>& out);

std::uint64_t count(std::span<const ObjectRun> runs);

}  // namespace manzana::culling
