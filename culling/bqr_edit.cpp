#include "culling/bqr_edit.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <numeric>

#include "culling/pack.h"

namespace manzana::culling {
namespace {

constexpr std::uint32_t kNowhere = ~0U;

std::uint16_t bit(std::uint32_t lane) { return static_cast<std::uint16_t>(1U << lane); }

template <class F>
void each_lane(unsigned lanes, F f) {
  for (; lanes != 0; lanes &= lanes - 1) f(static_cast<std::uint32_t>(std::countr_zero(lanes)));
}

std::uint32_t lane_of(const BqrNode& parent, std::uint32_t child) {
  std::uint32_t found = kNowhere;
  each_lane(parent.lanes & ~parent.blocks & 0xFFFFU,
            [&](std::uint32_t i) { found = parent.child[i] == child ? i : found; });
  return found;
}

double distance(const BoxD& box, const Vec3d& p) {
  return glm::length(glm::max(glm::max(box.min - p, p - box.max), 0.0));
}

/// The child node whose box is nearest to p, then whose middle is.
std::uint32_t nearest_child(const BqrNode& node, const Vec3d& p) {
  std::uint32_t best = kNowhere;
  std::pair least{std::numeric_limits<double>::infinity(), 0.0};
  each_lane(node.lanes & ~node.blocks & 0xFFFFU, [&](std::uint32_t i) {
    const BoxD box = lane_box(node, i);
    const std::pair far{distance(box, p), glm::length(center(box) - p)};
    if (far < least) best = node.child[i];
    least = std::min(least, far);
  });
  return best;
}

bool full(const BqrNode& node) { return node.lanes == 0xFFFF; }
std::uint32_t free_lane(const BqrNode& node) {
  return static_cast<std::uint32_t>(std::countr_one(static_cast<unsigned>(node.lanes)));
}

BoxD box_of(const BqrNode& node) {
  BoxD all;
  each_lane(node.lanes, [&](std::uint32_t i) { all = merge(all, lane_box(node, i)); });
  return all;
}

/// Of a full node: the half of the lanes that lies farther along the axis on which their middles are spread most.
std::uint16_t farther_half(const BqrNode& node) {
  std::array<std::pair<Vec3d, std::uint32_t>, kLanes> lanes;
  BoxD all;
  for (std::uint32_t i = 0; i < kLanes; ++i) lanes[i] = {center(lane_box(node, i)), i};
  for (const auto& [middle, lane] : lanes) all = merge(all, middle);
  const Vec3d size = all.max - all.min;
  const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
  const auto half = lanes.begin() + kLanes / 2;
  std::nth_element(lanes.begin(), half, lanes.end(),
                   [&](const auto& a, const auto& b) { return a.first[axis] < b.first[axis]; });
  return std::accumulate(half, lanes.end(), std::uint16_t{0}, [](std::uint16_t bits, const auto& lane) {
    return static_cast<std::uint16_t>(bits | bit(lane.second));
  });
}

/// A shift that leaves blocks four times as large their place.
std::uint8_t roomy_shift(const BoxD& box, double step) {
  const Vec3d steps = (box.max - box.min) / step;
  const double most = std::clamp(4 * std::max({steps.x, steps.y, steps.z}), 4.0, kLatticeEnd);
  return static_cast<std::uint8_t>(std::bit_width(65535U / static_cast<std::uint32_t>(most)) - 1);
}

/// Anew, whether it held something or not.
void set_lane(BqrNode& node, std::uint32_t lane, const BoxD& box, const SphereD& ball) {
  node.balls &= static_cast<std::uint16_t>(~bit(lane));
  set_volumes(node, lane, box, ball);
  leave_out_wide_balls(node);
  node.lanes |= bit(lane);
}

/// Lives for one insertion.
class Insertion {
 public:
  Insertion(BqrTree& tree, const BlockVolume& volume)
      : tree_(tree),
        box_{volume.box.min - tree.origin, volume.box.max - tree.origin},
        ball_(relative(volume.sphere, tree.origin)) {}

  /// Puts the block, whose objects have their run, into a lane.
  void place(std::uint32_t block, std::uint32_t row) {
    const std::uint32_t at = find_node();
    BqrNode& node = tree_.nodes[at];
    const std::uint32_t lane = free_lane(node);
    if (node.blocks == 0) node.shift = roomy_shift(box_, static_cast<double>(node.step));
    set_lane(node, lane, box_, ball_);
    node.blocks |= bit(lane);
    node.whole |= bit(lane);
    node.ordered = false;
    node.child[lane] = row;
    node.first[lane] = tree_.block_objects[block].first;
    node.last[lane] = tree_.block_objects[block].last;
    node.first_block[lane] = block;
    node.last_block[lane] = block + 1;
    tree_.place[block] = at * kLanes + lane;
  }

  /// All lanes above hold the block, and are no longer whole.
  void widen(std::uint32_t block, ClassMask classes) {
    std::uint32_t at = tree_.place[block] / kLanes;
    for (tree_.nodes[at].classes[tree_.place[block] % kLanes] = classes; at != tree_.root;
         at = tree_.nodes[at].parent) {
      BqrNode& above = tree_.nodes[tree_.nodes[at].parent];
      const std::uint32_t lane = lane_of(above, at);
      const BoxD box = merge(lane_box(above, lane), box_);
      set_lane(above, lane, box, enclosing_sphere(box));
      above.whole &= static_cast<std::uint16_t>(~bit(lane));
      above.classes[lane] |= classes;
    }
  }

 private:
  /// With a free lane, and lattices that reach over the block and are fine enough for it: the nearest.
  std::uint32_t find_node() {
    if (tree_.nodes.empty()) return tree_.root = add_node(box_);
    std::uint32_t at = tree_.root;
    for (std::uint32_t child = at; child != kNowhere; child = nearest_child(tree_.nodes[at], center(box_))) at = child;
    for (; !suits(at); at = tree_.nodes[at].parent)
      if (at == tree_.root) return put_above_root();
    if (!full(tree_.nodes[at])) return at;
    split(at);
    return find_node();
  }

  bool suits(std::uint32_t at) const {
    const BqrNode& node = tree_.nodes[at];
    if (!reached_from(at)) return false;
    const Vec3d steps = (box_.max - box_.min) / static_cast<double>(node.step) + 2.0;
    const double room = kLatticeEnd / static_cast<double>(1U << node.shift);
    return node.blocks == 0 || std::max({steps.x, steps.y, steps.z}) <= room;
  }
  /// The lattices of the node and of all above hold the block.
  bool reached_from(std::uint32_t at) const {
    const Lattice lattice = lattice_of(tree_.nodes[at]);
    const BoxD all = merge(box_, ball_.center);
    const bool here = glm::all(glm::lessThanEqual(lattice.corner, all.min)) &&
                      glm::all(glm::lessThanEqual(all.max, lattice.far_corner()));
    return here && (at == tree_.root || reached_from(tree_.nodes[at].parent));
  }

  std::uint32_t add_node(const BqrNode& node) {
    if (tree_.spare.empty()) {
      tree_.nodes.push_back(node);
      return static_cast<std::uint32_t>(tree_.nodes.size() - 1);
    }
    const std::uint32_t at = tree_.spare.back();
    tree_.spare.pop_back();
    tree_.nodes[at] = node;
    return at;
  }

  std::uint32_t add_node(const BoxD& box) {
    const Lattice lattice = make_lattice(merge(box, ball_.center));
    const std::uint32_t at = add_node(empty_node(lattice));
    tree_.nodes[at].parent = at;
    tree_.reach = std::max(tree_.reach, reach_of(lattice));
    return at;
  }

  /// What lies below, within the limits known so far, in a lane of the node `above`.
  void set_child(std::uint32_t above, std::uint32_t lane, std::uint32_t below, const BoxD& limits) {
    BqrNode& node = tree_.nodes[above];
    const BoxD all = box_of(tree_.nodes[below]);
    const BoxD box{glm::max(all.min, limits.min), glm::min(all.max, limits.max)};
    set_lane(node, lane, box, enclosing_sphere(box));
    node.whole &= static_cast<std::uint16_t>(~bit(lane));
    node.child[lane] = below;
    node.classes[lane] = all_classes(tree_.nodes[below]);
    tree_.nodes[below].parent = above;
  }

  /// The new root reaches farther than it must, or a city that grows at one end would get a level with each block.
  std::uint32_t put_above_root() {
    const std::uint32_t below = tree_.root;
    const BoxD old = box_of(tree_.nodes[below]), all = merge(old, box_);
    if (old.empty()) tree_.nodes.clear(), tree_.spare.clear();  // nothing is left below it
    tree_.root = add_node({all.min - (all.max - all.min), all.max + (all.max - all.min)});
    if (!old.empty()) set_child(tree_.root, 0, below, old);
    return tree_.root;
  }

  /// Half of the lanes go to a new node beside it, on the same lattice, so that blocks keep their packets.
  void split(std::uint32_t at) {
    if (at == tree_.root) put_above_root();
    if (full(tree_.nodes[tree_.nodes[at].parent])) split(tree_.nodes[at].parent);
    const std::uint16_t half = farther_half(tree_.nodes[at]);
    const std::uint32_t to = add_node(BqrNode(tree_.nodes[at]));
    keep(at, static_cast<std::uint16_t>(~half));
    keep(to, half);
    const std::uint32_t above = tree_.nodes[at].parent, lane = lane_of(tree_.nodes[above], at);
    const BoxD limits = lane_box(tree_.nodes[above], lane);
    set_child(above, lane, at, limits);
    set_child(above, free_lane(tree_.nodes[above]), to, limits);
  }

  /// Only these lanes, which know where they are.
  void keep(std::uint32_t at, std::uint16_t lanes) {
    BqrNode& node = tree_.nodes[at];
    for (std::uint16_t* bits : {&node.lanes, &node.blocks, &node.whole, &node.balls}) *bits &= lanes;
    each_lane(node.lanes & ~node.blocks & 0xFFFFU, [&](std::uint32_t i) { tree_.nodes[node.child[i]].parent = at; });
    each_lane(node.blocks, [&](std::uint32_t i) { tree_.place[node.first_block[i]] = at * kLanes + i; });
  }

  BqrTree& tree_;
  BoxD box_;
  SphereD ball_;
};

void leave(BqrNode& node, std::uint32_t lane) {
  for (std::uint16_t* bits : {&node.lanes, &node.blocks, &node.whole}) *bits &= static_cast<std::uint16_t>(~bit(lane));
}

/// The lane above a node from which something went. Its ball still holds what is left.
void shrink(BqrNode& above, std::uint32_t lane, const BqrNode& below) {
  const BoxD all = box_of(below), old = lane_box(above, lane);
  set_box(above, lane, {glm::max(all.min, old.min), glm::min(all.max, old.max)});
  above.whole &= static_cast<std::uint16_t>(~bit(lane));
  above.classes[lane] = all_classes(below);
}

/// All lanes above; a node in which nothing is left goes.
void shrink_above(BqrTree& tree, std::uint32_t at) {
  for (std::uint32_t parent = 0; at != tree.root; at = parent) {
    parent = tree.nodes[at].parent;
    const std::uint32_t lane = lane_of(tree.nodes[parent], at);
    if (tree.nodes[at].lanes != 0) {
      shrink(tree.nodes[parent], lane, tree.nodes[at]);
      continue;
    }
    leave(tree.nodes[parent], lane);
    tree.spare.push_back(at);
  }
}

void need_classes(BqrTree& tree) {
  if (tree.classes.empty()) tree.classes.assign(tree.objects() + kPacket, kAllClasses);
}

/// Room at the end of all that is per object; the row where the packets begin.
std::uint32_t append_room(BqrTree& tree, std::uint32_t count, bool classes) {
  const std::size_t packets = tree.packets.size();
  tree.packets.resize(packets + (rows_of(count) + kPacket - 1) / kPacket);
  if (classes) need_classes(tree);
  tree.object_order.resize(tree.objects() + count);
  if (!tree.classes.empty()) tree.classes.resize(tree.objects() + kPacket);
  return static_cast<std::uint32_t>(packets * kPacket);
}

Room new_room(BqrTree& tree, const NewObjects& objects) {
  const std::uint32_t first = tree.objects(), count = static_cast<std::uint32_t>(objects.boxes.size());
  const std::uint32_t row = append_room(tree, count, !objects.classes.empty());
  std::iota(tree.object_order.begin() + first, tree.object_order.end(), first);
  return {first, count, row};
}

void clear_rows(BqrTree& tree, const Room& room) {
  for (std::uint32_t row = room.row; row < room.row + rows_of(room.count); ++row)
    for (auto& column : tree.packets[row / kPacket].box) column[row % kPacket] = 0;
}

/// The rows of the room's objects, rising.
std::vector<std::uint32_t> rows_in(const BqrTree& tree, const Room& room) {
  const auto first = tree.object_order.begin() + room.first;
  std::vector<std::uint32_t> rows(first, first + room.count);
  std::sort(rows.begin(), rows.end());
  return rows;
}

void put(BqrTree& tree, std::uint32_t block, const BlockVolume& volume, const NewObjects& objects, const Room& room) {
  const std::uint32_t first = room.first, count = room.count;
  const std::vector<std::uint32_t> rows = rows_in(tree, room);
  if (tree.nodes.empty()) tree.origin = glm::round(center(volume.box));
  tree.block_objects[block] = {first, first + count};
  Insertion insertion(tree, volume);
  insertion.place(block, room.row);
  std::vector<ClassMask> all_of_all;
  if (objects.classes.empty()) all_of_all.assign(count, kAllClasses);
  pack_objects(tree, block, {{}, objects.boxes, objects.classes.empty() ? all_of_all : objects.classes}, 0, volume,
               ObjectOrder::z_curve);
  for (std::uint32_t i = first; i < first + count; ++i) tree.object_order[i] = rows[tree.object_order[i]];
  insertion.widen(block, block_classes(tree, block, volume.classes));
}

/// United anew over all below.
ClassMask unite(BqrTree& tree, std::uint32_t at, const std::vector<ClassMask>& of_block) {
  BqrNode& node = tree.nodes[at];
  each_lane(node.lanes, [&](std::uint32_t i) {
    const bool block = (node.blocks >> i & 1) != 0;
    node.classes[i] = block ? of_block[node.first_block[i]] : unite(tree, node.child[i], of_block);
  });
  return all_classes(node);
}

void refuse_bad(const BqrTree& tree, std::uint32_t block, const BlockVolume& volume, const NewObjects& objects) {
  assert(objects.classes.empty() || objects.classes.size() == objects.boxes.size());
  refuse_bad_block(volume, block);
  refuse_bad_objects(objects.boxes, objects.classes, volume, tree.objects());
}

}  // namespace

std::uint32_t insert_block(BqrTree& tree, const BlockVolume& volume, const NewObjects& objects) {
  const std::uint32_t block = tree.blocks();
  refuse_bad(tree, block, volume, objects);
  tree.block_objects.emplace_back();
  tree.place.push_back(kNowhere);
  tree.order.push_back(block);
  put(tree, block, volume, objects, new_room(tree, objects));
  return block;
}

Room remove_block(BqrTree& tree, std::uint32_t block) {
  assert(block < tree.blocks());
  if (tree.place[block] == kNowhere) return {};
  const std::uint32_t at = tree.place[block] / kLanes, lane = tree.place[block] % kLanes;
  const ObjectRun run = tree.block_objects[block];
  const Room room{run.first, run.last - run.first, tree.nodes[at].child[lane]};
  leave(tree.nodes[at], lane);
  tree.block_objects[block].last = run.first;
  tree.place[block] = kNowhere;
  shrink_above(tree, at);
  return room;
}

void change_block(BqrTree& tree, std::uint32_t block, const BlockVolume& volume, const NewObjects& objects) {
  assert(block < tree.blocks());
  refuse_bad(tree, block, volume, objects);
  remove_block(tree, block);
  put(tree, block, volume, objects, new_room(tree, objects));
}

void change_block(BqrTree& tree, std::uint32_t block, const BlockVolume& volume, const NewObjects& objects,
                  const Room& room) {
  assert(tree.place.at(block) == kNowhere && objects.boxes.size() == room.count);
  refuse_bad(tree, block, volume, objects);
  if (!objects.classes.empty()) need_classes(tree);
  clear_rows(tree, room);
  put(tree, block, volume, objects, room);
}

void set_classes(BqrTree& tree, std::span<const ClassMask> classes, std::span<const ClassMask> besides) {
  assert(classes.size() == tree.objects() && besides.size() == tree.blocks());
  tree.classes.assign(classes.begin(), classes.end());
  tree.classes.resize(classes.size() + kPacket);
  std::vector<ClassMask> of_block(tree.blocks());
  for (std::uint32_t b = 0; b < tree.blocks(); ++b) of_block[b] = block_classes(tree, b, besides[b]);
  if (!tree.nodes.empty()) unite(tree, tree.root, of_block);
}

}  // namespace manzana::culling
