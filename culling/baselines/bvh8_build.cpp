#include "culling/baselines/bvh8_build.h"

#include <algorithm>
#include <numeric>

namespace manzana::baselines {
namespace {

using culling::Box;

Box merge(const Box& a, const Box& b) { return {glm::min(a.min, b.min), glm::max(a.max, b.max)}; }

/// Lives for one call of build_tree8.
class Builder {
 public:
  explicit Builder(std::span<const Box> boxes) : boxes_(boxes) {
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
    for (const Box& box : boxes) centres_.push_back(box.min + box.max);  // twice the centre: only compared
  }

  Tree8 run() {
    const auto count = static_cast<std::uint32_t>(boxes_.size());
    std::uint32_t room = 8;
    while (room < count) room *= 8;
    tree_.nodes.emplace_back();
    if (count > 0) fill(0, {0, count}, std::max(room / 8, 8U));
    pack();
    return std::move(tree_);
  }

 private:
  struct Run {
    std::uint32_t first = 0, last = 0;
    std::uint32_t size() const { return last - first; }
  };

  /// Makes the children of a node, `room` objects in each but the last, and all below them.
  Box fill(std::size_t node, Run run, std::uint32_t room) {
    split(run, room);
    const bool lowest = room == 8;
    const std::uint32_t children = (run.size() + room - 1) / room;
    const auto below = static_cast<std::uint32_t>(tree_.nodes.size());
    if (!lowest) tree_.nodes.resize(tree_.nodes.size() + children);
    Box all;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const Run part{std::min(run.first + i * room, run.last), std::min(run.first + (i + 1) * room, run.last)};
      tree_.nodes[node].first[i] = part.first;
      if (i >= children) continue;
      const Box box = lowest ? bounds(part) : fill(below + i, part, room / 8);
      tree_.nodes[node].bounds.put(i, box);
      all = merge(all, box);
    }
    tree_.nodes[node].first[8] = run.last;
    tree_.nodes[node].below = below;
    tree_.nodes[node].children = (1U << children) - 1U;
    tree_.nodes[node].lowest = lowest;
    return all;
  }

  /// Orders the objects so that neighbours come to lie in the same `room` of them.
  void split(Run run, std::uint32_t room) {
    const std::uint32_t rooms = (run.size() + room - 1) / room;
    if (rooms < 2) return;
    const std::uint32_t middle = run.first + rooms / 2 * room;
    const int axis = longest_axis(run);
    const auto begin = tree_.order.begin();
    std::nth_element(begin + run.first, begin + middle, begin + run.last,
                     [&](std::uint32_t a, std::uint32_t b) { return centres_[a][axis] < centres_[b][axis]; });
    split({run.first, middle}, room);
    split({middle, run.last}, room);
  }

  int longest_axis(Run run) const {
    Box of_centres;
    for (std::uint32_t i = run.first; i < run.last; ++i) {
      const Vec3& centre = centres_[tree_.order[i]];
      of_centres = merge(of_centres, {centre, centre});
    }
    const Vec3 size = of_centres.max - of_centres.min;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  Box bounds(Run run) const {
    Box all;
    for (std::uint32_t i = run.first; i < run.last; ++i) all = merge(all, boxes_[tree_.order[i]]);
    return all;
  }

  void pack() {
    tree_.packets.resize((boxes_.size() + 7) / 8);
    for (std::size_t i = 0; i < boxes_.size(); ++i) tree_.packets[i / 8].put(i % 8, boxes_[tree_.order[i]]);
  }

  std::span<const Box> boxes_;
  std::vector<Vec3> centres_;
  Tree8 tree_;
};

}  // namespace

void Boxes8::put(std::size_t lane, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    columns[static_cast<std::size_t>(axis)][lane] = box.min[axis];
    columns[static_cast<std::size_t>(axis) + 3][lane] = box.max[axis];
  }
}

Tree8 build_tree8(std::span<const Box> boxes) { return Builder(boxes).run(); }

}  // namespace manzana::baselines
