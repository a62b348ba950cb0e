// The tree: every block and object in one place, every volume outward, whatever the input.
#include "culling/bqr_build.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

#include "culling/baselines/cases.h"
#include "culling/baselines/places.h"
#include "culling/baselines/random.h"
#include "tests/culling/tree_checks.h"

namespace manzana::culling::test {
namespace {

using baselines::Random;

/// A block round a middle, with n objects anywhere in it.
void add_block(Input& in, Random& random, const Vec3d& middle, const Vec3d& half, std::uint64_t n) {
  BoxD all{middle, middle};
  for (std::uint64_t i = 0; i < n; ++i) {
    const Vec3d at = middle + half * Vec3d{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    const Vec3d size = half * random.scale(1e-4, 0.5) * (random.chance(0.1) ? 0.0 : 1.0);
    in.boxes.push_back({at - size, at + size});
    all = merge(all, in.boxes.back());
  }
  in.blocks.push_back({Vec2d(middle), all, enclosing_sphere(all)});
  in.first.push_back(static_cast<std::uint32_t>(in.boxes.size()));
}

Input blocks_of(const std::vector<std::uint64_t>& counts, const Vec3d& place, std::uint64_t seed) {
  Random random(seed);
  Input in;
  for (const std::uint64_t n : counts)
    add_block(in, random, place + Vec3d{random.in(-500, 500), random.in(-500, 500), 0}, {40, 40, 10}, n);
  return in;
}

Input of_city(baselines::City city) {
  return {std::move(city.blocks), std::move(city.first), std::move(city.boxes), {}};
}

TEST_CASE("tree: no block, one block, blocks without objects") {
  CHECK(checked({}).nodes.empty());
  CHECK(checked(blocks_of({5}, Vec3d(0), 1)).nodes.size() == 1);
  CHECK(checked(blocks_of({0}, Vec3d(0), 1)).objects() == 0);
  CHECK(checked(blocks_of(std::vector<std::uint64_t>(300, 0), Vec3d(0), 2)).blocks() == 300);
  Input bare = blocks_of(std::vector<std::uint64_t>(40, 0), Vec3d(0), 2);
  const BqrTree tree = build_bqr_tree(bare.blocks);  // no objects at all, not even their runs
  TreeChecks(tree, bare).run();
}

TEST_CASE("tree: blocks of any number of objects, at any place") {
  const std::vector<std::uint64_t> counts{0, 1, 7, 8, 9, 31, 32, 33, 63, 64, 65, 1023, 1024, 1025, 0, 2049, 40000, 3};
  for (const baselines::Place& place : baselines::kPlaces) {
    INFO(place.name);
    checked(blocks_of(counts, place.at, 3));
  }
}

TEST_CASE("tree: a city, 10 000 and 100 000 objects") {
  checked(of_city(baselines::make_city(10'000, 4)));
  const BqrTree tree = checked(of_city(moved(baselines::make_city(100'000, 5), {676000.4, 4613000.7, 201.3})));
  CHECK(tree.origin == glm::round(tree.origin));
}

TEST_CASE("tree: coincident and degenerate centres") {
  Random random(6);
  const auto same = [&](int blocks, const auto& at) {
    Input in;
    for (int i = 0; i < blocks; ++i) add_block(in, random, at(i), {3, 3, 3}, random.below(4));
    return checked(in).nodes.size();
  };
  CHECK(same(16, [](int) { return Vec3d(9, 9, 0); }) == 1);
  CHECK(same(17, [](int) { return Vec3d(9, 9, 0); }) <= 3);
  CHECK(same(10'000, [](int) { return Vec3d(9, 9, 0); }) < 700);
  CHECK(same(1000, [](int i) { return Vec3d(std::ldexp(1.0, -i), std::ldexp(1.0, -i), 0); }) < 400);
  CHECK(same(1000, [](int i) { return Vec3d(i * 12.5, 3, 0); }) < 400);
  same(300, [](int i) { return Vec3d(i % 17 == 0 ? 5 : i, 5, 0); });
}

TEST_CASE("tree: from points to the farthest") {
  Random random(7);
  for (int trial = 0; trial < 60; ++trial) {
    Input in;
    const double widest = std::pow(10.0, trial % 2 == 0 ? random.in(-9, 36) : random.in(0, 8));
    for (int i = 0; i < 40; ++i) {
      const double size = random.chance(0.2) ? 0 : widest * random.scale(1e-9, 0.5);
      add_block(in, random, random.direction() * widest * random.unit(), Vec3d(size), random.below(5));
    }
    INFO("seed 7, trial " << trial << ", " << widest << " m");
    checked(in);
  }
  Input end;
  for (const double x : {-1e37, 1e37, 0.0}) {
    const BoxD box{Vec3d(x, 0, -1e37), Vec3d(x, 1, 1e37)};
    end.blocks.push_back({Vec2d(x, 0), box, {Vec3d(x, 0, 0), 1e37}});
    end.boxes.push_back(box);
    end.first.push_back(static_cast<std::uint32_t>(end.boxes.size()));
  }
  end.blocks[0].center = {-1e308, 1e308};
  checked(end);
}

TEST_CASE("tree: classes are united upward") {
  Random random(8);
  Input in = of_city(baselines::make_city(5000, 8));
  for (std::size_t i = 0; i < in.boxes.size(); ++i)
    in.classes.push_back(static_cast<ClassMask>(1U << random.below(3) | 1U << random.below(16)));
  for (BlockVolume& b : in.blocks) b.classes = random.chance(0.3) ? 0x8000 : 0;
  checked(in);
}

TEST_CASE("tree: does not depend on the order of the blocks") {
  Random random(41);
  for (int trial = 0; trial < 30; ++trial) {
    Input in, shuffled;
    for (int i = 0; i < 200; ++i) {
      const Vec3d c(Vec2d(static_cast<double>(random.below(12)), static_cast<double>(random.below(12))) * 9.0, 0);
      add_block(in, random, c, Vec3d(random.in(1, 2)), random.below(40));
    }
    std::vector<std::uint32_t> rows(in.blocks.size());
    for (std::uint32_t i = 0; i < rows.size(); ++i) rows[i] = i;
    for (std::size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[random.below(i)]);
    for (const std::uint32_t row : rows) {
      shuffled.blocks.push_back(in.blocks[row]);
      for (std::uint32_t i = in.first[row]; i < in.first[row + 1]; ++i) shuffled.boxes.push_back(in.boxes[i]);
      shuffled.first.push_back(static_cast<std::uint32_t>(shuffled.boxes.size()));
    }
    const BqrTree a = checked(in), b = checked(shuffled);
    REQUIRE(a.nodes.size() == b.nodes.size());
    REQUIRE(a.packets.size() == b.packets.size());
    for (std::size_t i = 0; i < a.packets.size(); ++i) REQUIRE(a.packets[i].box == b.packets[i].box);
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
      REQUIRE(a.nodes[i].corner == b.nodes[i].corner);
      REQUIRE(a.nodes[i].sphere == b.nodes[i].sphere);
      REQUIRE(a.nodes[i].box == b.nodes[i].box);
      REQUIRE(a.nodes[i].child == b.nodes[i].child);
    }
    for (std::size_t i = 0; i < a.object_order.size(); ++i)
      REQUIRE(in.boxes[a.object_order[i]].min == shuffled.boxes[b.object_order[i]].min);
  }
}

TEST_CASE("tree: the order of a block's objects is kept when asked for") {
  const std::vector<std::uint64_t> counts{0, 1, 8, 31, 32, 33, 64, 1025, 3000, 3};
  const Input in = blocks_of(counts, Vec3d(0), 5);
  const BqrTree tree = build_bqr_tree(in.blocks, in.objects(), {.order = ObjectOrder::given});
  TreeChecks(tree, in).run();
  for (const auto [first, last] : tree.block_objects)
    CHECK(std::is_sorted(tree.object_order.begin() + first, tree.object_order.begin() + last));
  const BqrTree along_curve = checked(in);
  CHECK_FALSE(along_curve.object_order == tree.object_order);
}

TEST_CASE("tree: a bad block is refused by its index") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Input good = blocks_of({1, 1, 1}, Vec3d(0), 9);
  const auto refused = [&](auto change) {
    Input in = good;
    change(in.blocks[1]);
    CHECK_THROWS_AS(build_bqr_tree(in.blocks, in.objects()), std::invalid_argument);
    CHECK_THROWS_WITH(build_bqr_tree(in.blocks, in.objects()), Catch::Contains("block 1:"));
  };
  refused([&](BlockVolume& b) { b.center.x = nan; });
  refused([&](BlockVolume& b) { b.center.y = inf; });
  refused([&](BlockVolume& b) { b.sphere.radius = nan; });
  refused([&](BlockVolume& b) { b.sphere.radius = inf; });
  refused([&](BlockVolume& b) { b.sphere.radius = 1.1e37; });
  refused([&](BlockVolume& b) { b.sphere = SphereD{}; });
  refused([&](BlockVolume& b) { b.sphere.radius = -1; });
  refused([&](BlockVolume& b) { b.sphere.center.y = nan; });
  refused([&](BlockVolume& b) { b.box = BoxD{}; });
  refused([&](BlockVolume& b) { b.box.max.z = nan; });
  refused([&](BlockVolume& b) { b.box.min.x = -inf; });
  refused([&](BlockVolume& b) { b.box.max.z = 1.1e37; });
}

TEST_CASE("tree: a bad object is refused by its index") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Input good = blocks_of({3, 40, 2}, Vec3d(0), 10);
  good.classes.assign(good.boxes.size(), 1);
  const auto refused = [&](auto change) {
    Input in = good;
    change(in.boxes[17], in.classes[17]);
    CHECK_THROWS_AS(build_bqr_tree(in.blocks, in.objects()), std::invalid_argument);
    CHECK_THROWS_WITH(build_bqr_tree(in.blocks, in.objects()), Catch::Contains("object 17:"));
  };
  refused([&](BoxD& b, ClassMask&) { b = BoxD{}; });
  refused([&](BoxD& b, ClassMask&) { b.min.y = nan; });
  refused([&](BoxD& b, ClassMask&) { b.max.z = inf; });
  refused([&](BoxD& b, ClassMask&) { b.max.x = good.blocks[1].box.max.x + 1e-9; });
  refused([&](BoxD& b, ClassMask&) { b.min.z = good.blocks[1].box.min.z - 1e-9; });
  refused([&](BoxD&, ClassMask& c) { c = 0; });
}

/// Bytes of all vectors.
std::size_t all_bytes(const BqrTree& t) {
  return query_bytes(t) + t.block_objects.size() * sizeof(ObjectRun) +
         4 * (t.place.size() + t.order.size() + t.object_order.size());
}

TEST_CASE("tree: memory an object") {
  Input in = of_city(baselines::make_city(100'000, 11));
  in.classes.assign(in.boxes.size(), 1);
  const BqrTree tree = build_bqr_tree(in.blocks, in.objects());
  const auto each = [&](std::size_t bytes) { return static_cast<double>(bytes) / tree.objects(); };
  std::cout << "bytes an object, bounds and classes included: " << each(query_bytes(tree)) << " that a query reads, "
            << each(all_bytes(tree)) << " in all\n";
  CHECK(each(all_bytes(tree)) < 50);
}

TEST_CASE("time to build a tree of a million objects", "[.bench]") {
  const Input in = of_city(baselines::make_city(1'000'000, 1));
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 9; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const BqrTree tree = build_bqr_tree(in.blocks, in.objects());
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    REQUIRE(tree.objects() == 1'000'000);
  }
  std::cout << in.blocks.size() << " blocks, 1 000 000 objects: " << best << " s (best of 9)\n";
  CHECK(best < 0.25);
}

}  // namespace
}  // namespace manzana::culling::test
