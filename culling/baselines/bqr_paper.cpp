#include "culling/baselines/bqr_paper.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "culling/baselines/block_rows.h"
#include "culling/baselines/box_planes.h"
#include "culling/baselines/narrowed.h"
#include "culling/baselines/run_list.h"

namespace manzana::baselines {
namespace {

using culling::BlockVolume;
using culling::Sphere;

constexpr int kDeepest = 31;  ///< of quadrants: 100 km / 2^31 = 47 um
constexpr std::size_t kMostLevels = kDeepest + 2;

/// Depth first: the root is node 0, a node's descendants follow it, and the leaves of a node are one run.
struct Node {
  Sphere bounds;                      ///< encloses all leaves below
  std::uint32_t first = 0, last = 0;  ///< leaves [first, last)
  std::uint32_t skip = 0;             ///< the first node after this one's descendants
  std::uint32_t level = 0;            ///< the number of nodes above it
  bool leaf() const { return last - first == 1; }
};

struct Tree {
  Vec3d origin{0, 0, 0};
  Vec3 reach{0, 0, 0};  ///< no coordinate of any volume is larger
  std::vector<Node> nodes;
  std::vector<Corners> boxes;        ///< of the leaves
  std::vector<std::uint32_t> order;  ///< order[leaf] = block
};

/// Closed square of the plane, by its lower corner.
struct Quadrant {
  Vec2d low{0, 0};
  double size = 0;
  int depth = 0;
};

/// Lives for one call of build.
class Builder {
 public:
  Builder(std::span<const BlockVolume> blocks, const Vec3d& origin) : blocks_(blocks) {
    tree_.origin = origin;
    tree_.order.resize(blocks.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
  }

  Tree run() {
    if (!blocks_.empty()) grow(root(), 0, static_cast<std::uint32_t>(blocks_.size()));
    bound();
    return std::move(tree_);
  }

 private:
  /// The smallest square round all centres.
  Quadrant root() const {
    Vec2d low = blocks_[0].center, high = low;
    for (const BlockVolume& block : blocks_) {
      low = glm::min(low, block.center);
      high = glm::max(high, block.center);
    }
    return {low, glm::max(high.x - low.x, high.y - low.y), 0};
  }

  /// The node of leaves [first, last), whose centres lie in q, and all nodes below it. A quadrant with one block, or
  /// too small to be split, is a node's end; one with a single child that is not empty makes no node of its own.
  void grow(const Quadrant& q, std::uint32_t first, std::uint32_t last) {
    if (last - first == 1) return add_leaf(first);
    if (q.depth == kDeepest) return add_siblings(first, last);
    const auto ends = partition(q, first, last);
    const auto full = std::adjacent_find(ends.begin(), ends.end(),
                                         [&](std::uint32_t a, std::uint32_t b) { return b - a == last - first; });
    if (full != ends.end()) return grow(child_of(q, static_cast<unsigned>(full - ends.begin())), first, last);
    const std::size_t node = add_node(first, last);
    ++level_;
    for (unsigned which = 0; which < 4; ++which)
      if (ends[which] < ends[which + 1]) grow(child_of(q, which), ends[which], ends[which + 1]);
    --level_;
    close(node);
  }

  static Quadrant child_of(const Quadrant& q, unsigned which) {
    const double half = q.size / 2;
    return {q.low + half * Vec2d{which & 1U, which >> 1U}, half, q.depth + 1};
  }

  /// Orders the leaves by quadrant, bits (y, x): those of quadrant w are [ends[w], ends[w + 1]).
  std::array<std::uint32_t, 5> partition(const Quadrant& q, std::uint32_t first, std::uint32_t last) {
    const Vec2d middle = q.low + q.size / 2;
    const auto leaf = [&](std::uint32_t i) { return tree_.order.begin() + i; };
    const auto split = [&](std::uint32_t from, std::uint32_t to, int axis) {
      const auto below = [&](std::uint32_t b) { return blocks_[b].center[axis] < middle[axis]; };
      return static_cast<std::uint32_t>(std::partition(leaf(from), leaf(to), below) - leaf(0));
    };
    const std::uint32_t half = split(first, last, 1);
    return {first, split(first, half, 0), half, split(half, last, 0), last};
  }

  std::size_t add_node(std::uint32_t first, std::uint32_t last) {
    tree_.nodes.push_back({Sphere{}, first, last, 0, level_});
    return tree_.nodes.size() - 1;
  }
  void close(std::size_t node) { tree_.nodes[node].skip = static_cast<std::uint32_t>(tree_.nodes.size()); }
  void add_leaf(std::uint32_t leaf) { close(add_node(leaf, leaf + 1)); }
  void add_siblings(std::uint32_t first, std::uint32_t last) {
    const std::size_t node = add_node(first, last);
    ++level_;
    for (std::uint32_t leaf = first; leaf < last; ++leaf) add_leaf(leaf);
    --level_;
    close(node);
  }

  void bound() {
    std::vector<culling::SphereD> leaves;
    std::vector<culling::Box> boxes;
    for (const std::uint32_t b : tree_.order) {
      leaves.push_back(blocks_[b].sphere);
      boxes.push_back(narrow(blocks_[b].box, tree_.origin));
      tree_.boxes.push_back(to_corners(boxes.back()));
    }
    tree_.reach = reach_of(boxes);
    for (Node& node : tree_.nodes) {
      const auto below = std::span(leaves).subspan(node.first, node.last - node.first);
      node.bounds = narrow(node.leaf() ? below.front() : culling::enclosing_sphere(below), tree_.origin);
      tree_.reach = glm::max(tree_.reach, glm::abs(node.bounds.center) + node.bounds.radius);
    }
  }

  std::span<const BlockVolume> blocks_;
  Tree tree_;
  std::uint32_t level_ = 0;
};

class BqrPaper : public Peer {
 public:
  explicit BqrPaper(const City& city)
      : tree_(Builder(city.blocks, origin_of(city)).run()), rows_(rows_of(city, tree_.order)) {}

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    answer.runs.clear();
    if (tree_.nodes.empty()) return;
    const BoxPlanes planes(frustum, tree_.origin, tree_.reach);
    std::array<unsigned, kMostLevels> masks{BoxPlanes::kAll};  // what a node's parent reaches beyond, by level
    for (std::uint32_t i = 0; i < tree_.nodes.size();) {
      const Node& node = tree_.nodes[i];
      const unsigned crossed = ask(planes, node, masks[node.level]);
      const bool descend = crossed != BoxPlanes::kOutside && crossed != 0 && !node.leaf();
      if (descend) masks[node.level + 1] = crossed;
      if (crossed != BoxPlanes::kOutside && !descend)
        append(answer.runs, rows_.first[node.first], rows_.first[node.last]);
      i = descend ? i + 1 : node.skip;
    }
  }

  std::span<const std::uint32_t> order() const override { return rows_.rows; }

  std::size_t bytes() const override {
    return tree_.nodes.size() * sizeof(Node) + tree_.boxes.size() * sizeof(Corners) +
           rows_.first.size() * sizeof(std::uint32_t);
  }

 private:
  unsigned ask(const BoxPlanes& planes, const Node& node, unsigned mask) const {
    const unsigned crossed = planes.crossed(node.bounds, mask);
    if (crossed == BoxPlanes::kOutside || crossed == 0 || !node.leaf()) return crossed;
    return planes.outside(tree_.boxes[node.first], crossed) ? BoxPlanes::kOutside : crossed;
  }

  Tree tree_;
  BlockRows rows_;
};

}  // namespace

std::unique_ptr<Peer> make_bqr_paper(const City& city) { return std::make_unique<BqrPaper>(city); }

}  // namespace manzana::baselines
