#include "culling/quadtree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace manzana::culling {
namespace {

constexpr std::uint32_t kDeepest = 31;  // 100 km / 2^31 = 47 um; the key needs 63 bits
constexpr std::uint64_t kSharedQuadrant = std::uint64_t{1} << 63;

/// Half-open square of the plane, and the blocks [first, last) of the order whose centres it holds.
struct Quadrant {
  Vec2d low{0, 0}, high{0, 0};
  std::uint32_t first = 0, last = 0, depth = 0;
  std::uint64_t key = 1;
};

Vec2d middle(const Quadrant& q) { return {std::midpoint(q.low.x, q.high.x), std::midpoint(q.low.y, q.high.y)}; }

/// 0 to 3, bits (y, x); a centre on the border belongs to the upper side.
unsigned quadrant_of(const Vec2d& center, const Vec2d& mid) {
  return (center.y >= mid.y ? 2U : 0U) + (center.x >= mid.x ? 1U : 0U);
}

Quadrant child_of(const Quadrant& q, const Vec2d& mid, unsigned which) {
  Quadrant child = q;
  ((which & 1U) != 0 ? child.low : child.high).x = mid.x;
  ((which & 2U) != 0 ? child.low : child.high).y = mid.y;
  child.depth = q.depth + 1;
  child.key = q.key << 2 | which;
  return child;
}

std::array<double, 10> extent(const BlockVolume& b) {
  const auto& [low, high] = b.box;
  const Vec3d& c = b.sphere.center;
  return {low.x, low.y, low.z, high.x, high.y, high.z, c.x, c.y, c.z, b.sphere.radius};
}

/// Lives for one call of build_quadtree.
class Builder {
 public:
  explicit Builder(std::span<const BlockVolume> blocks) : blocks_(blocks) {}

  Quadtree run() {
    if (blocks_.empty()) return {};
    tree_.order.resize(blocks_.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
    todo_.push_back(root());
    while (!todo_.empty()) grow();
    link();
    return std::move(tree_);
  }

 private:
  const BlockVolume& block(std::uint32_t leaf) const { return blocks_[tree_.order[leaf]]; }

  /// The smallest square round all centres.
  Quadrant root() const {
    Quadrant q{blocks_[0].center, blocks_[0].center};
    for (const BlockVolume& b : blocks_) {
      q.low = glm::min(q.low, b.center);
      q.high = glm::max(q.high, b.center);
    }
    const Vec2d size = q.high - q.low;
    q.high = q.low + glm::max(size.x, size.y);
    q.last = static_cast<std::uint32_t>(blocks_.size());
    return q;
  }

  /// Makes the node of the next quadrant, after going down while only one quadrant of it holds all of its blocks.
  void grow() {
    Quadrant q = todo_.back();
    todo_.pop_back();
    if (q.last - q.first > 1) {
      while (splittable(q)) {
        const Vec2d mid = middle(q);
        const auto ends = partition(q, mid);
        const auto full = std::find(ends.begin(), ends.end(), std::array{q.first, q.last});
        if (full == ends.end()) return split(q, mid, ends);
        q = child_of(q, mid, static_cast<unsigned>(full - ends.begin()));
      }
      return share(q);
    }
    add(q);
  }

  bool splittable(const Quadrant& q) const {
    const Vec2d mid = middle(q);
    const bool halves = q.low.x < mid.x && mid.x < q.high.x && q.low.y < mid.y && mid.y < q.high.y;
    if (q.depth == kDeepest || !halves) return false;
    const auto begin = tree_.order.begin();
    return std::any_of(begin + q.first, begin + q.last,
                       [&](std::uint32_t i) { return blocks_[i].center != block(q.first).center; });
  }

  using Ends = std::array<std::array<std::uint32_t, 2>, 4>;

  /// Orders the blocks of q by quadrant; the runs of the four.
  Ends partition(const Quadrant& q, const Vec2d& mid) {
    const auto begin = tree_.order.begin();
    Ends ends{};
    std::uint32_t at = q.first;
    for (unsigned which = 0; which < 4; ++which) {
      const auto in = [&](std::uint32_t i) { return quadrant_of(blocks_[i].center, mid) == which; };
      const auto end = std::partition(begin + at, begin + q.last, in);
      ends[which] = {at, static_cast<std::uint32_t>(end - begin)};
      at = ends[which][1];
    }
    return ends;
  }

  void split(const Quadrant& q, const Vec2d& mid, const Ends& ends) {
    add(q);
    for (unsigned which = 4; which-- > 0;) {  // the first must come off the stack first
      Quadrant child = child_of(q, mid, which);
      child.first = ends[which][0];
      child.last = ends[which][1];
      if (child.first < child.last) todo_.push_back(child);
    }
  }

  /// A quadrant that cannot be split: its blocks become its leaves, in an order of their own.
  void share(const Quadrant& q) {
    const auto begin = tree_.order.begin();
    std::sort(begin + q.first, begin + q.last, [&](std::uint32_t a, std::uint32_t b) { return before(a, b); });
    add(q);
    for (std::uint32_t leaf = q.first; leaf < q.last; ++leaf) {
      Quadrant one = q;
      one.first = leaf;
      one.last = leaf + 1;
      one.key = kSharedQuadrant + leaf;
      add(one);
    }
  }

  bool before(std::uint32_t a, std::uint32_t b) const {
    const auto key = [&](std::uint32_t i) {
      return std::tuple(blocks_[i].center.x, blocks_[i].center.y, extent(blocks_[i]));
    };
    return key(a) < key(b);
  }

  void add(const Quadrant& q) { tree_.nodes.push_back({q.first, q.last, 0, q.depth, q.key}); }

  /// Depth first: what follows a node's last descendant is the first node whose leaves begin where its own end.
  void link() {
    auto& nodes = tree_.nodes;
    const auto end = static_cast<std::uint32_t>(nodes.size());
    for (std::uint32_t i = end; i-- > 0;) {
      std::uint32_t next = i + 1;
      while (next < end && nodes[next].first < nodes[i].last) next = nodes[next].skip;
      nodes[i].skip = next;
    }
  }

  std::span<const BlockVolume> blocks_;
  Quadtree tree_;
  std::vector<Quadrant> todo_;
};

}  // namespace

Quadtree build_quadtree(std::span<const BlockVolume> blocks) { return Builder(blocks).run(); }

}  // namespace manzana::culling
