#pragma once
/// From objects of several kinds to one tree and a table for each kind. The tree's objects are of all kinds, in one
/// order; a layer keeps its own in the same order, so a run of the tree's objects is one run of rows of every layer.
/// Within a block objects keep the order of their numbers. They are drawn in it: where walls lie in one plane, or
/// shadows overlap, what a picture shows is decided by what the scene was made from, not by how the tree sorts it.
///   SceneObjects objects;                                     // add() all of them, layer after layer
///   OrderedTree built = build_tree(volumes, objects);
///   for (std::uint32_t number : numbers_of(built, kTrees)) ... // a tree's rows are stored in this order
///   LayerTable trees = make_table(built, objects, kTrees);
#include <cstdint>
#include <span>
#include <vector>

#include "culling/bqr_tree.h"
#include "scenegraph/classes.h"

namespace manzana {

/// Which of the tree's objects are a layer's.
struct LayerTable {
  std::vector<std::uint32_t> row_first;  ///< objects of the tree + 1: how many of this layer's are before each
  std::vector<culling::Box> boxes;       ///< a row an object of the layer; relative to the tree's origin, outward
  std::uint32_t size() const { return static_cast<std::uint32_t>(boxes.size()); }
  culling::ObjectRun rows(const culling::ObjectRun& objects) const {
    return {row_first[objects.first], row_first[objects.last]};
  }
};

/// Of a row, in L. `origin`: the tree's.
inline culling::BoxD box_of(const LayerTable& table, std::uint32_t row, const Vec3d& origin) {
  const culling::Box& box = table.boxes[row];
  return {Vec3d(box.min) + origin, Vec3d(box.max) + origin};
}

/// How many of the layer's objects are in the runs of the tree's.
std::uint64_t count(const LayerTable& table, std::span<const culling::ObjectRun> objects);

/// Objects on their way into a tree, numbered as they are added.
struct SceneObjects {
  std::vector<std::uint32_t> blocks;  ///< of the builder's input
  std::vector<culling::BoxD> boxes;   ///< in L, within the block's
  std::vector<culling::ClassMask> classes;
  void add(std::uint32_t block, const culling::BoxD& box, culling::ClassMask kind);
};

/// numbers[object of the tree] = the object's number.
struct OrderedTree {
  culling::BqrTree tree;
  std::vector<std::uint32_t> numbers;
};

/// Throws as culling::build_bqr_tree does.
OrderedTree build_tree(std::span<const culling::BlockVolume> blocks, const SceneObjects& objects);

/// Of one of these classes, in the order of the tree.
std::vector<std::uint32_t> numbers_of(const OrderedTree& built, culling::ClassMask kinds);
LayerTable make_table(const OrderedTree& built, const SceneObjects& objects, culling::ClassMask kinds);

}  // namespace manzana
