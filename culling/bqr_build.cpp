#include "culling/bqr_build.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "culling/lattice.h"
#include "culling/pack.h"
#include "culling/quadtree.h"

namespace manzana::culling {
namespace {

constexpr std::uint32_t kNoQuad = ~0U;

/// Blocks [first, last) that become one lane: those of a quadrant, or part of one that holds too many to be opened.
struct Part {
  std::uint32_t first = 0, last = 0, quad = kNoQuad;
  std::uint32_t size() const { return last - first; }
};
using Parts = std::vector<Part>;

/// Lives for one call of build_bqr_tree.
class Builder {
 public:
  Builder(std::span<const BlockVolume> blocks, const BlockObjects& objects, const BqrBuildOptions& options)
      : in_(blocks), objects_(objects), options_(options) {}

  BqrTree run() {
    assert(objects_.first.empty() ? objects_.boxes.empty() : objects_.first.size() == in_.size() + 1);
    assert(objects_.first.empty() || objects_.first.back() == objects_.boxes.size());
    assert(objects_.classes.empty() || objects_.classes.size() == objects_.boxes.size());
    for (std::size_t i = 0; i < in_.size(); ++i) refuse_bad_block(in_[i], i);
    if (in_.empty()) return {};
    quads_ = build_quadtree(in_);
    tree_.order = quads_.order;
    gather();
    make_node({0, static_cast<std::uint32_t>(in_.size()), 0}, 0, 0);
    tbb::parallel_for(std::size_t{0}, in_.size(), [&](std::size_t b) { pack(static_cast<std::uint32_t>(b)); });
    unite_classes();
    return std::move(tree_);
  }

 private:
  /// Volumes relative to the origin and the runs of objects, in the tree's order.
  void gather() {
    BoxD all;
    for (const BlockVolume& b : in_) all = merge(all, b.box);
    tree_.origin = glm::round(center(all));
    const std::size_t n = in_.size();
    std::uint32_t objects = 0, rows = 0;
    for (const std::uint32_t row : tree_.order) {
      const BlockVolume& b = in_[row];
      boxes_.push_back({b.box.min - tree_.origin, b.box.max - tree_.origin});
      spheres_.push_back(relative(b.sphere, tree_.origin));
      const std::uint32_t count = objects_.first.empty() ? 0 : objects_.first[row + 1] - objects_.first[row];
      tree_.block_objects.push_back({objects, objects + count});
      packed_.push_back(first_row(rows, count));
      objects += count;
      rows = packed_.back() + rows_of(count);
    }
    tree_.place.resize(n);
    tree_.object_order.resize(objects);
    tree_.packets.resize((rows + kPacket - 1) / kPacket);
    if (!objects_.classes.empty()) tree_.classes.assign(objects + kPacket, 0);
  }

  Parts opened(const Part& part) const {
    Parts parts;
    if (part.quad == kNoQuad || (children(part.quad, parts), parts.size() > kLanes)) {
      parts.clear();
      std::uint64_t size = 1;  // powers of 16, so that the nodes below are full
      while (size * kLanes < part.size()) size *= kLanes;
      for (std::uint64_t at = part.first; at < part.last; at += size)
        parts.push_back({static_cast<std::uint32_t>(at),
                         static_cast<std::uint32_t>(std::min<std::uint64_t>(at + size, part.last))});
    }
    return parts;
  }
  void children(std::uint32_t quad, Parts& parts) const {
    for (std::uint32_t i = quad + 1; i < quads_.nodes[quad].skip; i = quads_.nodes[i].skip)
      parts.push_back({quads_.nodes[i].first, quads_.nodes[i].last, i});
  }
  static Parts single_blocks(const Part& part) {
    Parts parts;
    for (std::uint32_t b = part.first; b < part.last; ++b) parts.push_back({b, b + 1});
    return parts;
  }
  static void replace(Parts& lanes, std::size_t i, const Parts& by) {
    const auto at = lanes.erase(lanes.begin() + static_cast<std::ptrdiff_t>(i));
    lanes.insert(at, by.begin(), by.end());
  }

  /// The lanes of a node: the fullest are opened while there is room for their children; then half quadrants with few
  /// blocks are joined, and what little there is stands without a node of its own.
  Parts choose(const Part& part) const {
    if (part.size() <= kLanes) return single_blocks(part);
    Parts lanes = opened(part);
    while (open_fullest(lanes) || join_halves(lanes)) {
    }
    while (open_few(lanes)) {
    }
    return lanes;
  }
  bool open_fullest(Parts& lanes) const {
    const auto fuller = [](const Part& a, const Part& b) { return a.size() < b.size(); };
    const auto most = std::max_element(lanes.begin(), lanes.end(), fuller);
    if (most->size() <= kLanes) return false;
    const Parts by = opened(*most);
    if (lanes.size() - 1 + by.size() > kLanes) return false;
    replace(lanes, static_cast<std::size_t>(most - lanes.begin()), by);
    return true;
  }
  bool join_halves(Parts& lanes) const {
    for (std::size_t i = 0; i + 1 < lanes.size(); ++i) {
      if (lanes[i].size() + lanes[i + 1].size() > kLanes || !one_half(lanes[i], lanes[i + 1])) continue;
      lanes[i] = {lanes[i].first, lanes[i + 1].last};
      lanes.erase(lanes.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      return true;
    }
    return false;
  }
  /// Two quadrants side by side: their keys differ in the last bit, x.
  bool one_half(const Part& a, const Part& b) const {
    return a.quad != kNoQuad && b.quad != kNoQuad && quads_.nodes[a.quad].key >> 1 == quads_.nodes[b.quad].key >> 1;
  }
  /// The lane with the fewest blocks, beside the others without a node of its own, if there is room.
  static bool open_few(Parts& lanes) {
    std::size_t best = lanes.size();
    for (std::size_t i = 0; i < lanes.size(); ++i)
      if (lanes[i].size() > 1 && (best == lanes.size() || lanes[i].size() < lanes[best].size())) best = i;
    if (best == lanes.size() || lanes.size() - 1 + lanes[best].size() > kLanes) return false;
    replace(lanes, best, single_blocks(lanes[best]));
    return true;
  }

  SphereD ball_of(const Part& part) const {
    const auto below = std::span(spheres_).subspan(part.first, part.size());
    return part.size() == 1 ? below.front() : enclosing_sphere(below);
  }

  std::uint32_t make_node(const Part& part, std::uint32_t parent, std::uint16_t depth) {
    const Parts lanes = choose(part);
    const auto at = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    std::vector<SphereD> balls;
    for (const Part& lane : lanes) balls.push_back(ball_of(lane));
    const Lattice lattice = lattice_of(part, balls);
    BqrNode node = empty_node(lattice);
    node.parent = parent;
    node.depth = depth;
    for (std::uint32_t i = 0; i < lanes.size(); ++i) {
      set_volumes(node, i, box_of(lanes[i]), balls[i]);
      set_runs(node, i, lanes[i]);
      if (lanes[i].size() == 1) set_block(node, at, i, lanes[i].first);
    }
    leave_out_wide_balls(node);
    node.shift = finest_shift(node);
    tree_.nodes[at] = node;
    for (std::uint32_t i = 0; i < lanes.size(); ++i)
      if (lanes[i].size() > 1) {
        const std::uint32_t child = make_node(lanes[i], at, static_cast<std::uint16_t>(depth + 1));
        tree_.nodes[at].child[i] = child;
      }
    return at;
  }

  BoxD box_of(const Part& part) const {
    BoxD all;
    for (std::uint32_t b = part.first; b < part.last; ++b) all = merge(all, boxes_[b]);
    return all;
  }

  Lattice lattice_of(const Part& part, const std::vector<SphereD>& balls) {
    BoxD all = box_of(part);
    for (const SphereD& ball : balls) all = merge(all, ball.center);
    const Lattice lattice = make_lattice(all);
    tree_.reach = std::max(tree_.reach, reach_of(lattice));
    return lattice;
  }

  void set_runs(BqrNode& node, std::uint32_t i, const Part& part) const {
    node.lanes |= static_cast<std::uint16_t>(1U << i);
    node.whole |= static_cast<std::uint16_t>(1U << i);
    node.first[i] = tree_.block_objects[part.first].first;
    node.last[i] = tree_.block_objects[part.last - 1].last;
    node.first_block[i] = part.first;
    node.last_block[i] = part.last;
  }

  void set_block(BqrNode& node, std::uint32_t at, std::uint32_t i, std::uint32_t block) {
    node.blocks |= static_cast<std::uint16_t>(1U << i);
    node.child[i] = packed_[block];
    tree_.place[block] = at * kLanes + i;
  }

  void pack(std::uint32_t block) {
    const std::uint32_t row = tree_.order[block],
                        count = tree_.block_objects[block].last - tree_.block_objects[block].first;
    if (count > 0) pack_objects(tree_, block, objects_, objects_.first[row], in_[row], options_.order);
  }

  /// Children follow their parents, so one way back over the nodes.
  void unite_classes() {
    for (std::size_t at = tree_.nodes.size(); at-- > 0;) {
      BqrNode& node = tree_.nodes[at];
      for (std::uint32_t i = 0; i < kLanes; ++i) {
        if ((node.lanes >> i & 1) == 0) continue;
        const std::uint32_t block = node.first_block[i];
        node.classes[i] = (node.blocks >> i & 1) != 0 ? block_classes(tree_, block, in_[tree_.order[block]].classes)
                                                      : all_classes(tree_.nodes[node.child[i]]);
      }
    }
  }

  std::span<const BlockVolume> in_;
  const BlockObjects& objects_;
  const BqrBuildOptions options_;
  Quadtree quads_;
  BqrTree tree_;
  std::vector<BoxD> boxes_;
  std::vector<SphereD> spheres_;
  std::vector<std::uint32_t> packed_;  // the row where the packets of a block begin
};

}  // namespace

BqrTree build_bqr_tree(std::span<const BlockVolume> blocks, const BlockObjects& objects) {
  return build_bqr_tree(blocks, objects, {});
}

BqrTree build_bqr_tree(std::span<const BlockVolume> blocks, const BlockObjects& objects,
                       const BqrBuildOptions& options) {
  return Builder(blocks, objects, options).run();
}

std::size_t query_bytes(const BqrTree& tree) {
  return tree.nodes.size() * sizeof(BqrNode) + tree.packets.size() * sizeof(Packet) +
         tree.classes.size() * sizeof(ClassMask);
}

}  // namespace manzana::culling
