// The quadtree against a partition by integers, and its invariants on input that degenerates [numerics 4].
#include "culling/quadtree.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "culling/baselines/random.h"

namespace manzana::culling::test {
namespace {

using baselines::Random;
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

constexpr std::uint64_t kShared = std::uint64_t{1} << 63;

bool is_way_below(std::uint64_t key, std::uint64_t parent) {
  while (key > parent) key >>= 2;
  return key == parent;
}

/// Runs, skips and keys of the children of one node.
void check_children(const Quadtree& tree, std::uint32_t at) {
  const QuadNode& node = tree.nodes[at];
  std::uint32_t leaf = node.first, children = 0;
  for (std::uint32_t i = at + 1; i < node.skip; i = tree.nodes[i].skip, ++children) {
    const QuadNode& child = tree.nodes[i];
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
void check_tree(const Quadtree& tree, std::size_t blocks) {
  std::vector<std::uint32_t> sorted = tree.order;
  std::sort(sorted.begin(), sorted.end());
  REQUIRE(sorted.size() == blocks);
  for (std::uint32_t i = 0; i < sorted.size(); ++i) REQUIRE(sorted[i] == i);  // each block in one leaf
  std::set<std::uint64_t> keys;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    check_children(tree, i);
    keys.insert(tree.nodes[i].key);
  }
  REQUIRE(keys.size() == tree.nodes.size());
  if (blocks == 0) return;
  REQUIRE(tree.nodes[0].skip == tree.nodes.size());
  REQUIRE(tree.nodes[0].last == blocks);
  REQUIRE(tree.nodes[0].depth == 0);
  REQUIRE(tree.nodes[0].key == 1);
}

Quadtree built(const Centers& centers) {
  Quadtree tree = build_quadtree(blocks_at(centers));
  check_tree(tree, centers.size());
  return tree;
}

TEST_CASE("quadtree: no block, one block, two blocks") {
  CHECK(built({}).nodes.empty());
  const Quadtree one = built({{5, 5}});
  REQUIRE(one.nodes.size() == 1);
  CHECK(one.nodes[0].leaf());
  const Quadtree two = built({{5, 5}, {-5, 3}});
  REQUIRE(two.nodes.size() == 3);
  CHECK(two.order == std::vector<std::uint32_t>{1, 0});
  CHECK(two.nodes[1].key == 0b100);  // the square is 10 m wide from (-5, 3): west, south of its middle
  CHECK(two.nodes[2].key == 0b101);
}

TEST_CASE("quadtree: coincident centres become leaves of one node") {
  const Quadtree tree = built({{0, 0}, {9, 9}, {9, 9}, {9, 9}});
  REQUIRE(tree.nodes.size() == 6);
  CHECK(tree.nodes[2].key == 0b111);
  CHECK(tree.nodes[3].key == kShared + 1);
  CHECK(built(Centers(3, Vec2d(7, 7))).nodes.size() == 4);
  CHECK(built(Centers(10'000, Vec2d(7, 7))).nodes.size() == 10'001);
}

TEST_CASE("quadtree: a centre on the line belongs to the upper side") {
  const Quadtree tree = built({{0, 0}, {4, 4}, {8, 8}, {4, 0}, {0, 4}});
  std::map<std::uint32_t, std::uint64_t> key_of;
  for (const QuadNode& node : tree.nodes)
    if (node.leaf()) key_of[tree.order[node.first]] = node.key;
  CHECK(key_of[0] == 0b100);
  CHECK(is_way_below(key_of[1], 0b111));
  CHECK(is_way_below(key_of[2], 0b111));
  CHECK(key_of[3] == 0b101);
  CHECK(key_of[4] == 0b110);
}

TEST_CASE("quadtree: input that degenerates ends") {
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
  const Quadtree millimetre = pair_in({77, 77}, {77.001, 77});
  CHECK(std::none_of(millimetre.nodes.begin(), millimetre.nodes.end(),
                     [](const QuadNode& n) { return (n.key & kShared) != 0; }));
  built({{-1e7, 0}, {1e7, 0}, {5, 5}, {5.000001, 5}});
  built({{676000, 4613000}, {676000, std::nextafter(4613000.0, 5e6)}, {std::nextafter(676000.0, 7e5), 4613000}});
  pair_in({676000, 4613000}, {std::nextafter(676000.0, 7e5), 4613000});
  built({{5e-324, 0}, {0, 1e-323}, {0, 0}, {1e-323, 1.5e-323}});
  built({{-1e308, -1e308}, {1e308, 1e308}, {1.7e308, -1.7e308}, {4, 4}});
}

TEST_CASE("quadtree: does not depend on the order of the input") {
  Random random(41);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<BlockVolume> blocks;
    for (int i = 0; i < 200; ++i) {
      const Vec2d c{static_cast<double>(random.below(12)), static_cast<double>(random.below(12))};
      blocks.push_back(block_at(c, random.in(1, 2)));
    }
    std::vector<BlockVolume> shuffled = blocks;
    for (std::size_t i = shuffled.size(); i > 1; --i) std::swap(shuffled[i - 1], shuffled[random.below(i)]);
    const Quadtree a = build_quadtree(blocks), b = build_quadtree(shuffled);
    check_tree(a, blocks.size());
    REQUIRE(a.nodes.size() == b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) REQUIRE(a.nodes[i].key == b.nodes[i].key);
    for (std::size_t i = 0; i < a.order.size(); ++i)
      REQUIRE(blocks[a.order[i]].box.min == shuffled[b.order[i]].box.min);
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

TEST_CASE("quadtree: nodes are those of a brute-force partition by integers") {
  Random random(42);
  for (int trial = 0; trial < 60; ++trial) {
    Centers centers{{0, 0}, {0x100000, 0x100000}};
    const bool clumped = trial % 2 == 0;
    for (std::uint64_t n = random.below(300); n > 0; --n) {
      const auto coordinate = [&] { return static_cast<double>(random.below(clumped ? 40 : 0x100001)); };
      centers.push_back({coordinate(), coordinate()});
    }
    std::set<std::uint64_t> keys;
    for (const QuadNode& node : built(centers).nodes)
      if ((node.key & kShared) == 0) keys.insert(node.key);
    INFO("seed 42, trial " << trial);
    CHECK(keys == expected_keys(centers));
  }
}

}  // namespace
}  // namespace manzana::culling::test
