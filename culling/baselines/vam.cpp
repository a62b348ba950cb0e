#include "culling/baselines/vam.h"

#include <algorithm>
#include <cassert>

#include "culling/baselines/run_list.h"

namespace manzana::baselines {
namespace {

struct Item {
  Vec3 center;
  std::uint32_t index;
};

/// The dimension in which the centres vary most.
int widest(std::span<const Item> items) {
  Vec3d sum(0), squares(0);
  for (const Item& item : items) {
    const Vec3d c(item.center - items.front().center);
    sum += c;
    squares += c * c;
  }
  const Vec3d variance = squares - sum * sum / static_cast<double>(items.size());
  if (variance.x >= variance.y) return variance.x >= variance.z ? 0 : 2;
  return variance.y >= variance.z ? 1 : 2;
}

/// The multiple of `capacity` nearest to half of `count`, which is larger than `capacity`.
std::size_t split_at(std::size_t count, std::size_t capacity) { return (count + capacity) / (2 * capacity) * capacity; }

/// What the smallest tree holds that is full and has room for `count`.
std::size_t full_root(std::size_t count, std::size_t page) {
  while (page < count) page *= kVamFanout;
  return page;
}

/// Orders `items` so that each full subtree of `capacity` items is a run, and within it those of the levels below.
void arrange(std::span<Item> items, std::size_t capacity, std::size_t page) {
  while (items.size() <= capacity && capacity > page) capacity /= kVamFanout;
  if (items.size() <= capacity) return;
  const int axis = widest(items);
  const std::size_t half = split_at(items.size(), capacity);
  const auto before = [axis](const Item& a, const Item& b) {
    return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis] : a.index < b.index;
  };
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(), before);
  arrange(items.first(half), capacity, page);
  arrange(items.subspan(half), capacity, page);
}

Corners merge(std::span<const Corners> boxes) {
  Corners all = boxes.front();
  for (const Corners& box : boxes)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all[axis] = std::min(all[axis], box[axis]);
      all[axis + 3] = std::max(all[axis + 3], box[axis + 3]);
    }
  return all;
}

/// A level above `below`.
VamTree::Level bound(const VamTree::Level& below, std::uint32_t entries) {
  VamTree::Level level{{}, entries, below.items * entries};
  const std::span<const Corners> boxes = below.boxes;
  level.boxes.reserve((boxes.size() + entries - 1) / entries);
  for (std::size_t first = 0; first < boxes.size(); first += entries)
    level.boxes.push_back(merge(boxes.subspan(first, std::min<std::size_t>(entries, boxes.size() - first))));
  return level;
}

struct Walk {
  const VamTree& tree;
  const BoxPlanes& planes;
  std::size_t bottom;
  std::vector<culling::ObjectRun>& out;

  /// Entries [first, last) of a level, of which it is known that they lie inside all planes but those of `mask`.
  void visit(std::size_t level, std::uint32_t first, std::uint32_t last, unsigned mask) {
    if (level == 0) return visit_items(first, last, mask);
    const VamTree::Level& here = tree.levels[level];
    const VamTree::Level& below = tree.levels[level - 1];
    for (std::uint32_t i = first; i < last; ++i) {
      const unsigned crossed = planes.crossed(here.boxes[i], mask);
      if (crossed == BoxPlanes::kOutside) continue;
      if (crossed == 0 || level == bottom)
        append(out, i * here.items, end(tree.levels[0], i, here.items));
      else
        visit(level - 1, i * here.entries, end(below, i, here.entries), crossed);
    }
  }

  void visit_items(std::uint32_t first, std::uint32_t last, unsigned mask) {
    const Corners* boxes = tree.levels[0].boxes.data();
    for (std::uint32_t i = first; i < last; ++i)
      if (!planes.outside(boxes[i], mask)) append(out, i, i + 1);
  }

  static std::uint32_t end(const VamTree::Level& level, std::uint32_t entry, std::uint32_t each) {
    return std::min((entry + 1) * each, static_cast<std::uint32_t>(level.boxes.size()));
  }
};

}  // namespace

VamTree build_vam_tree(std::span<const culling::BoxD> boxes, std::uint32_t page) {
  assert(page > 0);
  VamTree tree;
  if (boxes.empty()) return tree;
  culling::BoxD bounds;
  for (const culling::BoxD& box : boxes) bounds = merge(bounds, box);
  tree.origin = glm::round(center(bounds));
  std::vector<Item> items;
  items.reserve(boxes.size());
  for (const culling::BoxD& box : boxes)
    items.push_back({Vec3(center(box) - tree.origin), static_cast<std::uint32_t>(items.size())});
  arrange(items, full_root(items.size(), page), page);

  VamTree::Level level{{}, 0, 1};
  level.boxes.reserve(items.size());
  tree.order.reserve(items.size());
  for (const Item& item : items) {
    const culling::Box box = narrow(boxes[item.index], tree.origin);
    tree.order.push_back(item.index);
    tree.reach = glm::max(tree.reach, reach_of({&box, 1}));
    level.boxes.push_back(to_corners(box));
  }
  tree.levels.push_back(std::move(level));
  tree.levels.push_back(bound(tree.levels[0], page));
  while (tree.levels.back().boxes.size() > kVamFanout) tree.levels.push_back(bound(tree.levels.back(), kVamFanout));
  return tree;
}

std::size_t bytes(const VamTree& tree) {
  std::size_t sum = 0;
  for (const VamTree::Level& level : tree.levels) sum += level.boxes.size() * sizeof(Corners);
  return sum;
}

void cull(const VamTree& tree, const BoxPlanes& planes, VamGrain grain, std::vector<culling::ObjectRun>& out) {
  out.clear();
  if (tree.levels.empty()) return;
  Walk walk{tree, planes, grain == VamGrain::items ? 0U : 1U, out};
  const std::size_t root = tree.levels.size() - 1;
  walk.visit(root, 0, static_cast<std::uint32_t>(tree.levels[root].boxes.size()), BoxPlanes::kAll);
}

}  // namespace manzana::baselines
