#pragma once
/// BqR-Tree: an R-tree shaped by an adaptive quadtree over the centres of city blocks, with the blocks' objects in it.
/// [Pina, Cerezo, Seron: Bq-Rtree (2009), section 3; called Pina 2009]
///   BqrTree tree = build_bqr_tree(blocks, {first, boxes});     // once; store the objects by tree.object_order
///   Answer answer(tree);
///   cull(tree, make_planes(tree, make_frustum(view)), answer); // culling/cull.h, each frame: runs of objects
/// A block goes whole to the quadrant of its centre (culling/quadtree.h). The paper bounds quadrants by spheres and
/// blocks by the intersection of a sphere and a box; here both are bounded by such intersections, made over the blocks
/// below: cities are flat, and a sphere round a square kilometre crosses planes far above its roofs
/// (docs/measurements.md). What also differs is how it lies in memory. A node tests 16 children at once: quadrants are
/// opened, the fullest first, until 16 stand side by side. Volumes are 16-bit distances on a lattice
/// (culling/lattice.h), rounded outward. The objects below a lane are one run, so a lane that is inside emits its run
/// untested. A block's objects are packets of 32 boxes in columns, on a finer lattice of the block.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "culling/volumes.h"

namespace manzana::culling {

/// Sets of classes, a bit each: buildings, trees, whatever the host tells apart. Never 0.
using ClassMask = std::uint16_t;
inline constexpr ClassMask kAllClasses = 0xFFFF;

/// What the tree must know of a block: metres, in L. `box` and `sphere` enclose all of its content (including its
/// half-streets and the cars on them); `center` is the geometric centre of its ground, which decides the quadrant.
struct BlockVolume {
  Vec2d center{0, 0};
  BoxD box;
  SphereD sphere;
  ClassMask classes = 0;  ///< of what it holds besides its objects: cars
};

/// The objects of all blocks: those of block b are rows [first[b], first[b + 1]). Boxes in L, metres, within the
/// block's. Without `classes` every object is of all classes.
struct BlockObjects {
  std::span<const std::uint32_t> first;
  std::span<const BoxD> boxes;
  std::span<const ClassMask> classes;
};

/// Half-open run of objects.
struct ObjectRun {
  std::uint32_t first = 0, last = 0;
  bool operator==(const ObjectRun&) const = default;
};

inline constexpr std::uint32_t kLanes = 16;   ///< children of a node
inline constexpr std::uint32_t kPacket = 32;  ///< objects of a packet
inline constexpr std::uint32_t kFew = 4;      ///< packets of a block that are asked without others round them

using Lanes16 = std::array<std::uint16_t, kLanes>;
using Lanes32 = std::array<std::uint32_t, kLanes>;

/// Boxes of up to 32 objects: their reaches on the lattice of their block, a column after the other; unused rows are 0.
/// A column is a cache line, and a plane asks three. Blocks with few objects share packets, a row of theirs after the
/// other: a query then reads less.
struct alignas(64) Packet {
  std::array<std::array<std::uint16_t, kPacket>, 6> box{};
};

/// Up to 16 children side by side, on the node's lattice. A lane is a node, a block, or nothing. What a query reads
/// first stands first: it comes to nodes cold.
struct alignas(64) BqrNode {
  Vec3 corner{0, 0, 0};                 ///< of the lattice, relative to the tree's origin; exact
  float step = 1;                       ///< of the lattice, metres; a power of two
  std::uint16_t lanes = 0;              ///< bit i: lane i holds something
  std::uint16_t blocks = 0;             ///< bit i: lane i is a block
  std::uint16_t whole = 0;              ///< bit i: all objects below lane i are the run [first[i], last[i]), no hole
  std::uint16_t balls = 0;              ///< bit i: the sphere of lane i cuts much off its box's corners, so it is asked
  std::uint8_t shift = 0;               ///< the lattices of its blocks are 2^shift times finer
  bool ordered = true;                  ///< last[i] = first[j] for any two neighbours i, j that hold something
  std::uint16_t depth = 0;              ///< nodes above
  std::uint32_t parent = 0;             ///< the root is its own
  Lanes16 classes{};                    ///< united over all objects below
  std::array<Lanes16, 6> box{};         ///< reaches
  Lanes32 first{}, last{};              ///< objects
  Lanes32 child{};                      ///< a node; or the row where a block's packets begin, 32 a packet
  std::array<Lanes16, 4> sphere{};      ///< centre x, y, z; radius in units of the test
  Lanes32 first_block{}, last_block{};  ///< blocks
};

struct BqrTree {
  Vec3d origin{0, 0, 0};  ///< in L, whole metres; all volumes are relative to it
  double reach = 0;       ///< no lattice reaches farther from the origin, metres
  std::uint32_t root = 0;
  std::vector<BqrNode> nodes;               ///< as built: depth first, the root first
  std::vector<Packet> packets;              ///< of a block with many: first those that enclose 32 packets each
  std::vector<ClassMask> classes;           ///< a row an object, and 32 to spare; empty: all are of all classes
  std::vector<ObjectRun> block_objects;     ///< a row a block, in the tree's order
  std::vector<std::uint32_t> place;         ///< of a block: node * 16 + lane
  std::vector<std::uint32_t> order;         ///< order[block] = index in the builder's input
  std::vector<std::uint32_t> object_order;  ///< object_order[object] = row of the builder's input
  std::vector<std::uint32_t> spare;         ///< nodes that edits left empty, for the next that need one
  std::uint32_t blocks() const { return static_cast<std::uint32_t>(block_objects.size()); }
  std::uint32_t objects() const { return static_cast<std::uint32_t>(object_order.size()); }
};

/// O(n log n); on both the blocks and the objects of one block parallel. No block: no node. Does not depend on the
/// order of the blocks. Within a block objects follow a Z-curve. Throws std::invalid_argument, with the index, for a
/// block whose centre is not finite or whose volume is empty, not finite or beyond 1e37 m, and for an object whose box
/// is empty, not finite or not within its block's box, or whose class mask is 0.
BqrTree build_bqr_tree(std::span<const BlockVolume> blocks, const BlockObjects& objects = {});

/// Bytes of all that a query may read.
std::size_t query_bytes(const BqrTree& tree);

/// Volumes as they are tested: outward from those of the input, but for what double rounds of `reach`, which the
/// planes' margin covers. In metres, relative to the tree's origin.
SphereD lane_sphere(const BqrNode& node, std::uint32_t lane);
BoxD lane_box(const BqrNode& node, std::uint32_t lane);

}  // namespace manzana::culling
