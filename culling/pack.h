#pragma once
/// How volumes are written into nodes and packets; shared by the builder and by edits.
#include "culling/bqr_build.h"
#include "culling/lattice.h"

namespace manzana::culling {

/// Throw as build_bqr_tree does, with that index; the rows of objects begin at `from`.
void refuse_bad_block(const BlockVolume& volume, std::size_t index);
void refuse_bad_objects(std::span<const BoxD> boxes, std::span<const ClassMask> classes, const BlockVolume& volume,
                        std::size_t from);

/// Relative to an origin, enlarged by more than the subtraction's error.
SphereD relative(const SphereD& sphere, const Vec3d& origin);

BqrNode empty_node(const Lattice& lattice);
Lattice lattice_of(const BqrNode& node);

/// Volumes of a lane, relative to the tree's origin, on the node's lattice: the box and the ball's centre must be
/// within it, what reaches beyond is cut off.
void set_volumes(BqrNode& node, std::uint32_t lane, const BoxD& box, const SphereD& ball);

/// The box alone: what is in the lane has not grown.
void set_box(BqrNode& node, std::uint32_t lane, const BoxD& box);

/// Leaves out the spheres that cut little off the corners of their boxes: what they tell does not pay for the asking.
void leave_out_wide_balls(BqrNode& node);

/// How much finer the lattices of a node's blocks can be: that of the largest must not end before its box does.
std::uint8_t finest_shift(const BqrNode& node);

/// Rows of packets, 32 each, that a block with so many objects takes. Before more than a few packets come some whose
/// boxes enclose a packet each.
std::uint32_t rows_of(std::uint32_t objects);

/// Where these rows begin, if those before `free` are taken: a block that fits into one packet is in one, a block that
/// does not begins one.
std::uint32_t first_row(std::uint32_t free, std::uint32_t objects);

/// Writes the packets, the classes and the order of a block's objects; the block has its place, its run and room for
/// its packets. Rows of the input from `from`. Throws for bad objects.
void pack_objects(BqrTree& tree, std::uint32_t block, const BlockObjects& objects, std::uint32_t from,
                  const BlockVolume& volume, ObjectOrder order);

/// Of the block's objects, and `others`; all classes if the tree has none. Of all lanes of a node.
ClassMask block_classes(const BqrTree& tree, std::uint32_t block, ClassMask others);
ClassMask all_classes(const BqrNode& node);

}  // namespace manzana::culling
