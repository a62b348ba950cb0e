#pragma once
/// What holds for every BqR-Tree, by brute force over all that lies below each lane.
#include "tests/culling/volume_checks.h"

namespace manzana::culling::test {

/// The input of build_bqr_tree.
struct Input {
  std::vector<BlockVolume> blocks;
  std::vector<std::uint32_t> first{0};
  std::vector<BoxD> boxes;
  std::vector<ClassMask> classes;
  BlockObjects objects() const { return {first, boxes, classes}; }
};

class TreeChecks {
 public:
  TreeChecks(const BqrTree& tree, const Input& in) : tree_(tree), in_(in), volumes_(tree), seen_(tree.nodes.size()) {}

  void run() {
    check_orders();
    if (in_.blocks.empty()) {
      REQUIRE(tree_.nodes.empty());
      return;
    }
    const BqrNode& root = tree_.nodes.at(tree_.root);
    REQUIRE(root.parent == tree_.root);
    REQUIRE(root.depth == 0);
    REQUIRE(check_node(tree_.root) == LeafEnds{0, tree_.blocks(), 0, tree_.objects()});
    REQUIRE(std::find(seen_.begin(), seen_.end(), false) == seen_.end());
    for (std::uint32_t b = 0; b < tree_.blocks(); ++b)
      volumes_.check_packets(b, [&](std::uint32_t i) { return in_.boxes[tree_.object_order[i]]; });
  }

 private:
  struct LeafEnds {
    std::uint32_t first_block, last_block, first, last;
    bool operator==(const LeafEnds&) const = default;
  };

  void check_orders() const {
    REQUIRE(tree_.blocks() == in_.blocks.size());
    REQUIRE(tree_.order.size() == in_.blocks.size());
    REQUIRE(tree_.place.size() == in_.blocks.size());
    REQUIRE(tree_.objects() == in_.boxes.size());
    check_permutation(tree_.order);
    check_permutation(tree_.object_order);
    std::uint32_t at = 0;
    for (std::uint32_t b = 0; b < tree_.blocks(); ++b) {
      REQUIRE(tree_.block_objects[b].first == at);
      at = tree_.block_objects[b].last;
      const std::uint32_t row = tree_.order[b];
      REQUIRE(at - tree_.block_objects[b].first == in_.first[row + 1] - in_.first[row]);
      for (std::uint32_t i = tree_.block_objects[b].first; i < at; ++i) {
        REQUIRE(tree_.object_order[i] >= in_.first[row]);
        REQUIRE(tree_.object_order[i] < in_.first[row + 1]);
      }
    }
    REQUIRE(at == tree_.objects());
  }

  /// All that lies below, as its lanes say.
  LeafEnds check_node(std::uint32_t at) {
    const BqrNode& node = tree_.nodes.at(at);
    REQUIRE_FALSE(seen_[at]);
    seen_[at] = true;
    REQUIRE(node.lanes != 0);
    REQUIRE((node.blocks & ~node.lanes) == 0);
    REQUIRE(node.whole == node.lanes);
    REQUIRE(node.ordered);
    volumes_.check_lattice(lattice_of(node));
    LeafEnds all{};
    for (std::uint32_t i = 0, n = 0; i < kLanes; ++i) {
      if ((node.lanes >> i & 1) == 0) continue;
      const LeafEnds ends{node.first_block[i], node.last_block[i], node.first[i], node.last[i]};
      if (n++ == 0) all = {ends.first_block, ends.first_block, ends.first, ends.first};
      REQUIRE(ends.first_block == all.last_block);
      REQUIRE(ends.first == all.last);
      all.last_block = ends.last_block;
      all.last = ends.last;
      check_lane(at, i, ends);
    }
    return all;
  }

  void check_lane(std::uint32_t at, std::uint32_t i, const LeafEnds& ends) {
    const BqrNode& node = tree_.nodes[at];
    REQUIRE(node.classes[i] == classes_below(ends));
    for (std::uint32_t b = ends.first_block; b < ends.last_block; ++b)
      volumes_.check_below(node, i, in_.blocks[tree_.order[b]]);
    if ((node.blocks >> i & 1) != 0) {
      REQUIRE(ends.last_block == ends.first_block + 1);
      REQUIRE(tree_.place[ends.first_block] == at * kLanes + i);
      REQUIRE(tree_.block_objects[ends.first_block] == ObjectRun{ends.first, ends.last});
    } else {
      REQUIRE(ends.last_block > ends.first_block + 1);
      REQUIRE(tree_.nodes.at(node.child[i]).parent == at);
      REQUIRE(tree_.nodes[node.child[i]].depth == node.depth + 1);
      REQUIRE(check_node(node.child[i]) == ends);
    }
  }

  ClassMask classes_below(const LeafEnds& ends) const {
    if (in_.classes.empty()) return kAllClasses;
    ClassMask all = 0;
    for (std::uint32_t i = ends.first; i < ends.last; ++i) all |= in_.classes[tree_.object_order[i]];
    for (std::uint32_t b = ends.first_block; b < ends.last_block; ++b) all |= in_.blocks[tree_.order[b]].classes;
    return all;
  }

  const BqrTree& tree_;
  const Input& in_;
  VolumeChecks volumes_;
  std::vector<bool> seen_;
};

inline BqrTree checked(const Input& in) {
  BqrTree tree = build_bqr_tree(in.blocks, in.objects());
  TreeChecks(tree, in).run();
  return tree;
}

}  // namespace manzana::culling::test
