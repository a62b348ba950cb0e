// The VAMSplit R-tree of the benchmark: packed as White and Jain say, and culled as a flat list of its boxes.
#include "culling/baselines/vam.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <iostream>
#include <numeric>

#include "tests/support/random.h"

namespace manzana::baselines {
namespace {

using culling::BoxD;
using culling::ObjectRun;
using Vec3l = glm::vec<3, long double>;

/// Flat as a city, so that heights never vary most.
std::vector<BoxD> scattered(std::size_t count, const Vec3d& place, std::uint64_t seed) {
  support::Random random(seed);
  std::vector<BoxD> boxes;
  while (boxes.size() < count) {
    const Vec3d at{random.within(-900, 900), random.within(-400, 400), random.within(0, 20)};
    const Vec3d half{random.within(0.1, 9), random.within(0.1, 9), random.within(0.1, 30)};
    boxes.push_back({place + at - half, place + at + half});
  }
  return boxes;
}

std::vector<BoxD> stacked(std::size_t count) { return {count, BoxD{{1, 2, 3}, {4, 5, 6}}}; }

struct Input {
  std::vector<BoxD> boxes;
  std::uint32_t page;
};

std::vector<Input> inputs() {
  std::vector<Input> all;
  for (const std::size_t count : {1, 15, 16, 17, 255, 256, 257, 3000, 4096, 4097, 70000})
    all.push_back({scattered(count, {4.6e6, -7e4, 4.2e6}, 31 + count), 16});
  for (const std::uint32_t page : {1U, 2U, 4U, 6U, 8U}) all.push_back({scattered(4000, {0, 0, 0}, 41 + page), page});
  all.push_back({stacked(300), 16});
  return all;
}

Vec3l middle(const BoxD& box) { return (Vec3l(box.min) + Vec3l(box.max)) / 2.0L; }

bool holds(const VamTree& tree, const Corners& outer, const BoxD& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    const auto origin = static_cast<long double>(tree.origin[axis]);
    if (static_cast<long double>(outer[at]) + origin > static_cast<long double>(box.min[axis])) return false;
    if (static_cast<long double>(outer[at + 3]) + origin < static_cast<long double>(box.max[axis])) return false;
  }
  return true;
}

TEST_CASE("a VAMSplit R-tree holds every item once, in full pages but for the last") {
  for (const auto& [boxes, page] : inputs()) {
    const VamTree tree = build_vam_tree(boxes, page);
    INFO(boxes.size() << " items, " << page << " a page");
    std::vector<std::uint32_t> sorted = tree.order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> rows(boxes.size());
    std::iota(rows.begin(), rows.end(), 0U);
    REQUIRE(sorted == rows);

    REQUIRE(tree.levels.size() >= 2);
    CHECK(tree.levels[1].entries == page);
    CHECK(tree.levels.back().boxes.size() <= kVamFanout);
    for (std::size_t k = 1; k < tree.levels.size(); ++k) {
      const std::size_t below = tree.levels[k - 1].boxes.size(), each = tree.levels[k].entries;
      CHECK(tree.levels[k].boxes.size() == (below + each - 1) / each);
      if (k > 1) CHECK(each == kVamFanout);
    }
  }
}

TEST_CASE("every box of a VAMSplit R-tree contains all that lies below it") {
  for (const auto& [boxes, page] : inputs()) {
    const VamTree tree = build_vam_tree(boxes, page);
    for (const VamTree::Level& level : tree.levels)
      for (std::size_t position = 0; position < boxes.size(); ++position)
        REQUIRE(holds(tree, level.boxes[position / level.items], boxes[tree.order[position]]));
  }
}

/// The splits that led to a run of positions, each against the text of the paper.
class Splits {
 public:
  Splits(const std::vector<BoxD>& boxes, const VamTree& tree) {
    for (const std::uint32_t row : tree.order) centers_.push_back(middle(boxes[row]));
  }

  void check(std::size_t first, std::size_t last, std::size_t capacity, std::size_t page) {
    const std::size_t count = last - first;
    if (count <= capacity) {
      if (capacity > page) check(first, last, capacity / kVamFanout, page);
      return;
    }
    const std::size_t half = first + nearest_multiple(count, capacity);
    REQUIRE(divided(first, half, last));
    ++checked;
    check(first, half, capacity, page);
    check(half, last, capacity, page);
  }

  std::size_t checked = 0;

 private:
  /// By trying them all.
  static std::size_t nearest_multiple(std::size_t count, std::size_t capacity) {
    std::size_t best = capacity;
    const auto off = [&](std::size_t at) { return at * 2 > count ? at * 2 - count : count - at * 2; };
    for (std::size_t at = capacity; at < count; at += capacity)
      if (off(at) <= off(best)) best = at;
    return best;
  }

  Vec3l variance(std::size_t first, std::size_t last) const {
    const auto count = static_cast<long double>(last - first);
    Vec3l mean(0), sum(0);
    for (std::size_t i = first; i < last; ++i) mean += centers_[i] / count;
    for (std::size_t i = first; i < last; ++i) sum += (centers_[i] - mean) * (centers_[i] - mean);
    return sum / count;
  }

  /// Along a dimension of largest variance (the builder's sums are double, of centres in float) no centre on the left
  /// lies above one on the right.
  bool divided(std::size_t first, std::size_t half, std::size_t last) const {
    const Vec3l spread = variance(first, last);
    const long double most = std::max({spread.x, spread.y, spread.z});
    for (int axis = 0; axis < 3; ++axis) {
      if (spread[axis] < most * (1 - 1e-6L)) continue;
      long double left = centers_[first][axis], right = centers_[half][axis];
      for (std::size_t i = first; i < half; ++i) left = std::max(left, centers_[i][axis]);
      for (std::size_t i = half; i < last; ++i) right = std::min(right, centers_[i][axis]);
      if (left <= right + 1e-3L) return true;
    }
    return false;
  }

  std::vector<Vec3l> centers_;
};

TEST_CASE("a VAMSplit R-tree is split where the variance is largest, near the median") {
  std::size_t checked = 0;
  for (const auto& [boxes, page] : inputs()) {
    const VamTree tree = build_vam_tree(boxes, page);
    std::size_t capacity = page;
    while (capacity < boxes.size()) capacity *= kVamFanout;
    Splits splits(boxes, tree);
    INFO(boxes.size() << " items, " << page << " a page");
    splits.check(0, boxes.size(), capacity, page);
    checked += splits.checked;
  }
  CHECK(checked > 5000);
}

std::vector<bool> flags(const std::vector<ObjectRun>& runs, std::size_t count) {
  std::vector<bool> seen(count);
  for (const ObjectRun& run : runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) seen[i] = true;
  return seen;
}

/// Which positions lie in an entry of the level that is not outside.
std::vector<bool> flat(const VamTree& tree, const BoxPlanes& planes, std::size_t level) {
  std::vector<bool> seen;
  for (std::size_t i = 0; i < tree.order.size(); ++i)
    seen.push_back(!planes.outside(tree.levels[level].boxes[i / tree.levels[level].items], BoxPlanes::kAll));
  return seen;
}

culling::View any_view(const Vec3d& place, support::Random& random) {
  const Vec3d at{random.within(-1000, 1000), random.within(-500, 500), random.within(0, 200)};
  const Vec3d forward{random.within(-1, 1), random.within(-1, 1), random.within(-1, 0.2)};
  const double far_m = random.below(2) == 0 ? random.within(10, 2000) : std::numeric_limits<double>::infinity();
  return culling::look(place + at, forward, {0, 0, 1}, random.within(0.1, 2.5), random.within(0.5, 2), 0.1, far_m);
}

TEST_CASE("a VAMSplit R-tree answers as a flat list of its objects, or of its pages") {
  support::Random random(51);
  std::size_t seen_items = 0, items = 0, joined = 0;
  for (const auto& [boxes, page] : inputs()) {
    const VamTree tree = build_vam_tree(boxes, page);
    std::vector<ObjectRun> runs;
    for (int i = 0; i < 40; ++i) {
      const culling::FrustumD frustum = make_frustum(any_view(tree.origin, random));
      const BoxPlanes planes(frustum, tree.origin, tree.reach);
      cull(tree, planes, VamGrain::pages, runs);
      REQUIRE(flags(runs, boxes.size()) == flat(tree, planes, 1));
      cull(tree, planes, VamGrain::items, runs);
      const std::vector<bool> seen = flags(runs, boxes.size());
      REQUIRE(seen == flat(tree, planes, 0));
      for (std::size_t r = 1; r < runs.size(); ++r) REQUIRE(runs[r - 1].last < runs[r].first);
      seen_items += static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
      items += seen.size();
      joined += runs.size();
    }
  }
  std::cout << "VAMSplit: " << seen_items << " of " << items << " taken in " << joined << " runs\n";
  CHECK(seen_items > items / 50);
  CHECK(seen_items < items / 2);
}

TEST_CASE("a VAMSplit R-tree of nothing answers nothing") {
  std::vector<ObjectRun> runs{{0, 1}};
  const VamTree tree = build_vam_tree({}, 16);
  cull(tree, BoxPlanes(culling::make_frustum({}), tree.origin, tree.reach), VamGrain::items, runs);
  CHECK(runs.empty());
}

}  // namespace
}  // namespace manzana::baselines
