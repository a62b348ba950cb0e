#pragma once
/// Whether lanes and packets contain what they must, in long double, which subtracts two doubles of a city without
/// rounding.
#include <algorithm>
#include <catch2/catch.hpp>

#include "culling/lattice.h"
#include "culling/pack.h"

namespace manzana::culling::test {

using Real = long double;
using Vec3l = glm::vec<3, Real>;

inline void check_permutation(std::vector<std::uint32_t> rows) {
  std::sort(rows.begin(), rows.end());
  for (std::uint32_t i = 0; i < rows.size(); ++i) REQUIRE(rows[i] == i);
}

class VolumeChecks {
 public:
  // A difference of doubles rounds by half a unit, twice until it stands on the lattice; the margin of the planes is
  // dozens of times larger (culling/planes.cpp).
  explicit VolumeChecks(const BqrTree& tree) : tree_(tree), tolerance_(static_cast<Real>(tree.reach) * 0x1p-52L) {}

  void check_lattice(const Lattice& l) const {
    const Vec3l far = glm::max(glm::abs(Vec3l(l.corner)), glm::abs(Vec3l(l.far_corner())));
    REQUIRE(glm::length(far) <= static_cast<Real>(tree_.reach) * (1 + 0x1p-50L));
  }

  /// The lane's ball is round the block's ball or round its box: both enclose all that the block holds.
  void check_below(const BqrNode& node, std::uint32_t i, const BlockVolume& block) const {
    REQUIRE(contains(lane_box(node, i), block.box));
    if (node.sphere[3][i] == 65535) return;  // never outside, never inside
    const SphereD ball = lane_sphere(node, i);
    const Vec3l low = relative_exactly(block.box.min) - Vec3l(ball.center),
                high = relative_exactly(block.box.max) - Vec3l(ball.center);
    const Real away = glm::length(relative_exactly(block.sphere.center) - Vec3l(ball.center));
    REQUIRE(std::min(away + static_cast<Real>(block.sphere.radius), glm::length(glm::max(-low, high))) <=
            static_cast<Real>(ball.radius) + tolerance_);
  }

  /// The boxes in a block's packets, and those round its packets. box_of(object).
  template <class F>
  void check_packets(std::uint32_t b, F box_of) const {
    const BqrNode& node = tree_.nodes[tree_.place[b] / kLanes];
    const std::uint32_t lane = tree_.place[b] % kLanes;
    const auto [first, last] = tree_.block_objects[b];
    const std::uint32_t n = last - first, packets = (n + kPacket - 1) / kPacket,
                        enclosing = packets > kFew ? (packets + kPacket - 1) / kPacket : 0;
    const std::size_t begin = node.child[lane];
    if (n > 0) REQUIRE(begin + rows_of(n) <= tree_.packets.size() * kPacket);
    REQUIRE((n == 0 || begin % kPacket + std::min(n, kPacket) <= kPacket));  // one packet, or the first of several
    const BoxD frame = lane_box(node, lane);
    const double step = std::ldexp(static_cast<double>(node.step), -node.shift);
    for (std::uint32_t i = 0; i < n; ++i) {
      const BoxD& box = box_of(first + i);
      const std::uint32_t p = i / kPacket;
      const BoxD own = decoded(frame, step, begin + enclosing * kPacket + i);
      REQUIRE(contains(own, box));
      REQUIRE(within(own, box, static_cast<Real>(step)));
      if (enclosing == 0) continue;
      REQUIRE(contains(decoded(frame, step, begin + p), box));
    }
  }

 private:
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

  BoxD decoded(const BoxD& frame, double step, std::size_t row) const {
    const auto at = [&](std::uint32_t k) { return step * tree_.packets.at(row / kPacket).box.at(k).at(row % kPacket); };
    return {frame.max - Vec3d(at(3), at(4), at(5)), frame.min + Vec3d(at(0), at(1), at(2))};
  }

  const BqrTree& tree_;
  Real tolerance_;
};

}  // namespace manzana::culling::test
