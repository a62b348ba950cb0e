#pragma once
/// Changes of a BqR-Tree without a rebuild of the rest: a block is built, torn down or altered.
///   const std::uint32_t block = insert_block(tree, volume, {boxes});   // its objects are the tree's last
///   remove_block(tree, block);
///   change_block(tree, block, volume, {boxes}, remove_block(tree, block));   // it moves: in the same room, for ever
/// A block goes into the node nearest to it; a full one is split, as in any R-tree. What lies below a lane is then no
/// longer one run, so that queries go further down there; a coarse lattice stays coarse, and the room of objects that
/// are gone is used again only by who is given it: after very many other changes build anew. BqrNode::depth stays the
/// builder's. No query may run at the same time; answers make room by themselves.
#include "culling/bqr_tree.h"

namespace manzana::culling {

/// Of one block. Without classes every object is of all classes; the first with classes costs a tree without them a
/// row for every object that it has.
struct NewObjects {
  std::span<const BoxD> boxes;
  std::span<const ClassMask> classes;
};

/// The number of the new block: the next. Its objects get the next numbers, along a Z-curve; in object_order they
/// follow the builder's rows. O(depth), and the time to append to the tree's vectors. Throws as build_bqr_tree does,
/// and then nothing has changed.
std::uint32_t insert_block(BqrTree& tree, const BlockVolume& volume, const NewObjects& objects = {});

/// What the objects of a block took up: so many numbers from `first`, and rows of packets from `row`.
struct Room {
  std::uint32_t first = 0, count = 0, row = 0;
};

/// No query finds the block or its objects any more; their numbers stay unused until somebody is given the room.
/// Volumes and classes above shrink to what is left. O(depth).
Room remove_block(BqrTree& tree, std::uint32_t block);

/// Another volume and other objects under the same number; the objects get the next numbers.
void change_block(BqrTree& tree, std::uint32_t block, const BlockVolume& volume, const NewObjects& objects = {});

/// The same, of a block that is not there; its objects, as many as `room` had, get the numbers of that, which a removal
/// left and nobody else was given.
void change_block(BqrTree& tree, std::uint32_t block, const BlockVolume& volume, const NewObjects& objects,
                  const Room& room);

/// Other classes for all objects, a row each by their numbers; `besides`: a row a block, of what it holds besides its
/// objects. O(n).
void set_classes(BqrTree& tree, std::span<const ClassMask> classes, std::span<const ClassMask> besides);

}  // namespace manzana::culling
