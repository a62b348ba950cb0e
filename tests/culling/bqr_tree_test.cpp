// The tree against a partition by integers, and its invariants on input that degenerates [numerics 4].
#include "culling/bqr_tree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/culling/city.h"

namespace manzana::culling::test {
namespace {

using Centers = std::vector<Vec2d>;

BlockVolume block_at(const Vec2d& c, double half = 1) {
  const BoxD box{Vec3d(c - half, 0), Vec3d(c + half, 3)};
  return {c, box, enclosing_sphere(box)};
}

std::vector<BlockVolume> blocks_at(const Centers& centers) {
  std::vector<BlockVolume> blocks;
  for (const Vec2d& c : centers) blocks.push_back(block_at(c));
  return blocks;
}

bool contains(const Sphere& outer, const SphereD& inner, const Vec3d& origin) {
  using Vec3l = glm::vec<3, long double>;
  const Vec3l c = Vec3l(inner.center) - Vec3l(origin) - Vec3l(outer.center);
  return glm::length(c) + static_cast<long double>(inner.radius) <= static_cast<long double>(outer.radius);
}

constexpr std::uint64_t kShared = std::uint64_t{1} << 63;

bool is_way_below(std::uint64_t key, std::uint64_t parent) {
  while (key > parent) key >>= 2;
  return key == parent;
}

/// Runs, skips and keys of the children of one node.
void check_children(const BqrTree& tree, std::uint32_t at) {
  const BqrNode& node = tree.nodes[at];
  std::uint32_t leaf = node.first, children = 0;
  for (std::uint32_t i = at + 1; i < node.skip; i = tree.nodes[i].skip, ++children) {
    const BqrNode& child = tree.nodes[i];
    REQUIRE(child.first == leaf);
    leaf = child.last;
    if ((child.key & kShared) != 0)
      REQUIRE(child.key == kShared + child.first);
    else
      REQUIRE((is_way_below(child.key, node.key) && child.key != node.key));
  }
  if (node.leaf()) {
    REQUIRE(children == 0);
    REQUIRE(node.skip == at + 1);
  } else {
    REQUIRE(leaf == node.last);
    REQUIRE(children >= 2);  // chains are collapsed
  }
}

/// What holds for every tree.
void check_tree(const BqrTree& tree, const std::vector<BlockVolume>& blocks) {
  std::vector<std::uint32_t> sorted = tree.order;
  std::sort(sorted.begin(), sorted.end());
  REQUIRE(sorted.size() == blocks.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) REQUIRE(sorted[i] == i);  // each block in one leaf
  REQUIRE(tree.leaf_boxes.size() == blocks.size());
  std::set<std::uint64_t> keys;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    check_children(tree, i);
    keys.insert(tree.nodes[i].key);
    for (std::uint32_t leaf = tree.nodes[i].first; leaf < tree.nodes[i].last; ++leaf)
      REQUIRE(contains(tree.nodes[i].bounds, blocks[tree.order[leaf]].sphere, tree.origin));
  }
  REQUIRE(keys.size() == tree.nodes.size());
  if (blocks.empty()) return;
  REQUIRE(tree.nodes[0].skip == tree.nodes.size());
  REQUIRE(tree.nodes[0].last == blocks.size());
  REQUIRE(tree.nodes[0].depth == 0);
  REQUIRE(tree.nodes[0].key == 1);
}

BqrTree built(const Centers& centers) {
  const auto blocks = blocks_at(centers);
  BqrTree tree = build_bqr_tree(blocks);
  check_tree(tree, blocks);
  return tree;
}

TEST_CASE("no block, one block, two blocks") {
  CHECK(built({}).nodes.empty());
  const BqrTree one = built({{5, 5}});
  REQUIRE(one.nodes.size() == 1);
  CHECK(one.nodes[0].leaf());
  const BqrTree two = built({{5, 5}, {-5, 3}});
  REQUIRE(two.nodes.size() == 3);
  CHECK(two.order == std::vector<std::uint32_t>{1, 0});
  CHECK(two.nodes[1].key == 0b100);  // the square is 10 m wide from (-5, 3): west, south of its middle
  CHECK(two.nodes[2].key == 0b101);
}

TEST_CASE("coincident centres become leaves of one node") {
  const BqrTree tree = built({{0, 0}, {9, 9}, {9, 9}, {9, 9}});
  REQUIRE(tree.nodes.size() == 6);
  CHECK(tree.nodes[2].key == 0b111);
  CHECK(tree.nodes[3].key == kShared + 1);
  CHECK(built(Centers(3, Vec2d(7, 7))).nodes.size() == 4);
}

TEST_CASE("a centre on the line belongs to the upper side") {
  const BqrTree tree = built({{0, 0}, {4, 4}, {8, 8}, {4, 0}, {0, 4}});
  std::map<std::uint32_t, std::uint64_t> key_of;
  for (const BqrNode& node : tree.nodes)
    if (node.leaf()) key_of[tree.order[node.first]] = node.key;
  CHECK(key_of[0] == 0b100);
  CHECK(is_way_below(key_of[1], 0b111));
  CHECK(is_way_below(key_of[2], 0b111));
  CHECK(key_of[3] == 0b101);
  CHECK(key_of[4] == 0b110);
}

TEST_CASE("input that degenerates ends") {
  Centers line, halves, ring;
  for (int i = 0; i < 1000; ++i) line.push_back({i * 12.5, 3});
  for (int i = 0; i < 1000; ++i) halves.push_back({std::ldexp(1.0, -i), std::ldexp(1.0, -i)});
  for (int i = 0; i < 100; ++i) ring.push_back(1e5 * Vec2d(std::cos(i), std::sin(i)));
  built(line);
  built(halves);
  const auto pair_in = [&](const Vec2d& a, const Vec2d& b) {
    Centers all = ring;
    all.push_back(a);
    all.push_back(b);
    return built(all);
  };
  const BqrTree millimetre = pair_in({77, 77}, {77.001, 77});
  CHECK(std::none_of(millimetre.nodes.begin(), millimetre.nodes.end(),
                     [](const BqrNode& n) { return (n.key & kShared) != 0; }));
  built({{-1e7, 0}, {1e7, 0}, {5, 5}, {5.000001, 5}});
  built({{676000, 4613000}, {676000, std::nextafter(4613000.0, 5e6)}, {std::nextafter(676000.0, 7e5), 4613000}});
  pair_in({676000, 4613000}, {std::nextafter(676000.0, 7e5), 4613000});
  built({{5e-324, 0}, {0, 1e-323}, {0, 0}, {1e-323, 1.5e-323}});
}

TEST_CASE("centres at the end of double are handled, volumes there refused") {
  std::vector<BlockVolume> blocks = blocks_at({{1, 1}, {2, 2}, {3, 3}, {4, 4}});
  blocks[0].center = {-1e308, -1e308};
  blocks[1].center = {1e308, 1e308};
  blocks[2].center = {1.7e308, -1.7e308};
  check_tree(build_bqr_tree(blocks), blocks);
  CHECK_THROWS_WITH(build_bqr_tree(blocks_at({{0, 0}, {1e308, 1e308}})), Catch::Contains("block"));
}

TEST_CASE("what is empty or not finite is refused by its index") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<BlockVolume> good = blocks_at({{1, 1}, {2, 2}, {3, 3}});
  const auto refused = [&](auto change) {
    auto blocks = good;
    change(blocks[1]);
    CHECK_THROWS_AS(build_bqr_tree(blocks), std::invalid_argument);
    CHECK_THROWS_WITH(build_bqr_tree(blocks), Catch::Contains("block 1:"));
  };
  refused([&](BlockVolume& b) { b.center.x = nan; });
  refused([&](BlockVolume& b) { b.center.y = inf; });
  refused([&](BlockVolume& b) { b.sphere.radius = nan; });
  refused([&](BlockVolume& b) { b.sphere.radius = inf; });
  refused([&](BlockVolume& b) { b.sphere = SphereD{}; });
  refused([&](BlockVolume& b) { b.sphere.radius = -1; });
  refused([&](BlockVolume& b) { b.box = BoxD{}; });
  refused([&](BlockVolume& b) { b.box.max.z = nan; });
  refused([&](BlockVolume& b) { b.box.max.z = inf; });
  refused([&](BlockVolume& b) { b.box.max.z = 1e300; });
}

TEST_CASE("the tree does not depend on the order of the input") {
  Random random(41);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<BlockVolume> blocks;
    for (int i = 0; i < 200; ++i) {
      const Vec2d c{static_cast<double>(random.below(12)), static_cast<double>(random.below(12))};
      blocks.push_back(block_at(c, random.in(1, 2)));
    }
    std::vector<BlockVolume> shuffled = blocks;
    for (std::size_t i = shuffled.size(); i > 1; --i) std::swap(shuffled[i - 1], shuffled[random.below(i)]);
    const BqrTree a = build_bqr_tree(blocks), b = build_bqr_tree(shuffled);
    check_tree(a, blocks);
    REQUIRE(a.nodes.size() == b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
      REQUIRE(a.nodes[i].key == b.nodes[i].key);
      REQUIRE(a.nodes[i].bounds.center == b.nodes[i].bounds.center);
      REQUIRE(a.nodes[i].bounds.radius == b.nodes[i].bounds.radius);
    }
    for (std::size_t i = 0; i < a.order.size(); ++i) {
      REQUIRE(blocks[a.order[i]].box.min == shuffled[b.order[i]].box.min);
      REQUIRE(a.leaf_boxes[i].max == b.leaf_boxes[i].max);
    }
  }
}

/// Integers in a square of 2^20: the quadrant of a centre at each depth by shifting, the last row and column belonging
/// to the squares before them.
std::uint64_t way(const Vec2d& c, unsigned depth) {
  std::uint64_t key = 1;
  const auto index = [&](double v) {
    const auto cells = std::uint64_t{1} << depth;
    return std::min((static_cast<std::uint64_t>(v) << depth) >> 20, cells - 1);
  };
  for (unsigned d = depth; d-- > 0;) key = key << 2 | (index(c.y) >> d & 1) << 1 | (index(c.x) >> d & 1);
  return key;
}

/// Keys of the nodes that must be, by brute force over all depths.
std::set<std::uint64_t> expected_keys(const Centers& centers) {
  std::set<std::uint64_t> keys;
  std::map<std::uint64_t, bool> open{{1, true}};  // quadrants that go on being divided
  for (unsigned depth = 0; depth <= 31; ++depth) {
    std::map<std::uint64_t, Centers> members;
    for (const Vec2d& c : centers)
      if (depth == 0 || open.count(way(c, depth - 1)) != 0) members[way(c, depth)].push_back(c);
    std::map<std::uint64_t, bool> next;
    for (const auto& [key, list] : members) {
      const bool equal =
          std::all_of(list.begin(), list.end(), [&, &all = list](const Vec2d& c) { return c == all[0]; });
      std::set<std::uint64_t> children;
      for (const Vec2d& c : list) children.insert(way(c, depth + 1));
      const bool ends = list.size() == 1 || equal || depth == 31;
      if (ends || children.size() > 1) keys.insert(key);
      if (!ends) next[key] = true;
    }
    open = next;
  }
  return keys;
}

TEST_CASE("nodes are those of a brute-force partition by integers") {
  Random random(42);
  for (int trial = 0; trial < 60; ++trial) {
    Centers centers{{0, 0}, {0x100000, 0x100000}};
    const bool clumped = trial % 2 == 0;
    for (std::uint64_t n = random.below(300); n > 0; --n) {
      const auto coordinate = [&] { return static_cast<double>(random.below(clumped ? 40 : 0x100001)); };
      centers.push_back({coordinate(), coordinate()});
    }
    std::set<std::uint64_t> keys;
    for (const BqrNode& node : built(centers).nodes)
      if ((node.key & kShared) == 0) keys.insert(node.key);
    INFO("seed 42, trial " << trial);
    CHECK(keys == expected_keys(centers));
  }
}

TEST_CASE("origin: whole metres, in the middle of all content") {
  const BqrTree tree = build_bqr_tree(make_city(8, 3, 5, {676000.4, 4613000.7, 201.3}).blocks);
  CHECK(tree.origin == glm::round(tree.origin));
  CHECK(glm::length(tree.origin - Vec3d(676000, 4613000, 215)) < 40);
}

}  // namespace
}  // namespace manzana::culling::test
