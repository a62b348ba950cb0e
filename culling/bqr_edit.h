#pragma once
/// Changes of a BqR-Tree without a rebuild of the rest: a block that is built, torn down or altered.
///   const std::uint32_t block = insert_block(tree, volume, objects);   // objects().size() more objects, at the end
///   remove_block(tree, block);
/// What lies below a lane is then no longer one run, so a query descends further there; after many changes build anew.
/// Queries may not run at the same time.
#include "culling/bqr_tree.h"

namespace manzana::culling {

/// Boxes and classes of one block's objects. No classes: all classes.
struct NewObjects {
  std::span<const BoxD> boxes;
  std::span<const ClassMask> classes;
};

/// The number of the new block: the last. Its objects become the last, in the order of a Z-curve; object_order holds for
/// them the row that they would have if the new boxes followed all earlier ones. O(depth). Throws as build_bqr_tree
/// does, and then nothing has changed.
std::uint32_t insert_block(BqrTree& tree, const BlockVolume& volume, const NewObjects& objects = {});

/// The block's number and its objects' stay unused: no query finds them.
void remove_block(BqrTree& tree, std::uint32_t block);

/// Another volume, other objects, the same number: its objects become the last.
void change_block(BqrTree& tree, std::uint32_t block, const BlockVolume& volume, const NewObjects& objects = {});

}  // namespace manzana::culling
