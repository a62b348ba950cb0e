#pragma once
/// What holds for every BqR-Tree, by brute force over all that lies below each lane; in long double, which subtracts
/// two doubles of a city without rounding.
#include <algorithm>
#include <catch2/catch.hpp>

#include "culling/lattice.h"
#include "culling/pack.h"

namespace manzana::culling::test {

using Real = long double;
using Vec3l = glm::vec<3, Real>;

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
  TreeChecks(const BqrTree& tree, const Input& in) : tree_(tree), in_(in), seen_(tree.nodes.size()) {
    // A difference of doubles rounds by half a unit, twice until it stands on the lattice; the margin of the planes is
    // dozens of times larger (culling/planes.cpp).
    tolerance_ = static_cast<Real>(tree.reach) * 0x1p-52L;
  }

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
    for (std::uint32_t b = 0; b < tree_.blocks(); ++b) check_block(b);
  }

 private:
  struct LeafEnds {
    std::uint32_t first_block, last_block, first, last;
    bool operator==(const LeafEnds&) const = default;
  };

  static void check_permutation(std::vector<std::uint32_t> rows) {
    std::sort(rows.begin(), rows.end());
    for (std::uint32_t i = 0; i < rows.size(); ++i) REQUIRE(rows[i] == i);
  }

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
    check_lattice(lattice_of(node));
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

  void check_lattice(const Lattice& l) const {
    const Vec3l far = glm::max(glm::abs(Vec3l(l.corner)), glm::abs(Vec3l(l.far_corner())));
    REQUIRE(glm::length(far) <= static_cast<Real>(tree_.reach) * (1 + 0x1p-50L));
  }

  void check_lane(std::uint32_t at, std::uint32_t i, const LeafEnds& ends) {
    const BqrNode& node = tree_.nodes[at];
    REQUIRE(node.classes[i] == classes_below(ends));
    for (std::uint32_t b = ends.first_block; b < ends.last_block; ++b) check_below(node, i, in_.blocks[tree_.order[b]]);
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

  Vec3l relative_exactly(const Vec3d& p) const { return Vec3l(p) - Vec3l(tree_.origin); }

  bool contains(const BoxD& outer, const BoxD& inner) const {
    const Vec3l low = relative_exactly(inner.min) - Vec3l(outer.min),
                high = Vec3l(outer.max) - relative_exactly(inner.max);
    return std::min({low.x, low.y, low.z, high.x, high.y, high.z}) >= -tolerance_;
  }
  /// No farther out than that on any side.
  bool within(const BoxD& outer, const BoxD& inner, Real distance) const {
    const Vec3l low = relative_exactly(inner.min) - Vec3l(outer.min),
                high = Vec3l(outer.max) - relative_exactly(inner.max);
    return std::max({low.x, low.y, low.z, high.x, high.y, high.z}) <= distance + tolerance_;
  }

  void check_below(const BqrNode& node, std::uint32_t i, const BlockVolume& block) const {
    REQUIRE(contains(lane_box(node, i), block.box));
    if (node.sphere[3][i] == 65535) return;  // never outside, never inside
    const SphereD ball = lane_sphere(node, i);
    const Real away = glm::length(relative_exactly(block.sphere.center) - Vec3l(ball.center));
    REQUIRE(away + static_cast<Real>(block.sphere.radius) <= static_cast<Real>(ball.radius));
  }

  /// The boxes in a block's packets, and those round its packets.
  void check_block(std::uint32_t b) const {
    const BqrNode& node = tree_.nodes[tree_.place[b] / kLanes];
    const std::uint32_t lane = tree_.place[b] % kLanes;
    const auto [first, last] = tree_.block_objects[b];
    const std::uint32_t n = last - first, packets = (n + kPacket - 1) / kPacket,
                        enclosing = n > kPacket ? (packets + kPacket - 1) / kPacket : 0;
    const std::size_t begin = std::size_t{node.child[lane]} * 8;
    if (n > 0) REQUIRE(begin + std::size_t{packed_size(n)} * 8 + kPacket <= tree_.packets.size());
    const std::uint32_t length = n > kPacket ? kPacket : (n + 7) / 8 * 8;
    const BoxD frame = lane_box(node, lane);
    const double step = std::ldexp(static_cast<double>(node.step), -node.shift);
    for (std::uint32_t i = 0; i < n; ++i) {
      const BoxD& box = in_.boxes[tree_.object_order[first + i]];
      const std::uint32_t p = i / kPacket;
      const BoxD own = decoded(frame, step, begin + std::size_t{enclosing + p} * 6 * kPacket, length, i % kPacket);
      REQUIRE(contains(own, box));
      REQUIRE(within(own, box, static_cast<Real>(step)));
      if (enclosing == 0) continue;
      const std::size_t round = begin + std::size_t{p / kPacket} * 6 * kPacket;
      REQUIRE(contains(decoded(frame, step, round, kPacket, p % kPacket), box));
    }
  }

  BoxD decoded(const BoxD& frame, double step, std::size_t packet, std::uint32_t length, std::uint32_t i) const {
    const auto at = [&](std::uint32_t k) { return step * tree_.packets.at(packet + std::size_t{k} * length + i); };
    return {frame.max - Vec3d(at(3), at(4), at(5)), frame.min + Vec3d(at(0), at(1), at(2))};
  }

  const BqrTree& tree_;
  const Input& in_;
  std::vector<bool> seen_;
  Real tolerance_ = 0;
};

inline BqrTree checked(const Input& in) {
  BqrTree tree = build_bqr_tree(in.blocks, in.objects());
  TreeChecks(tree, in).run();
  return tree;
}

}  // namespace manzana::culling::test
