// One tree for several layers: each object in its layer once, where the tree has it.
#include "scenegraph/layer_table.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "tests/support/random.h"

namespace manzana {
namespace {

constexpr std::array kKinds{kBuilding, kSurface, kTree};

struct Made {
  std::vector<culling::BlockVolume> blocks;
  SceneObjects objects;
  OrderedTree built;
};

void add_objects(Made& made, support::Random& random, std::uint32_t block, int count) {
  for (int i = 0; i < count; ++i) {
    const culling::BoxD& ground = made.blocks[block].box;
    const Vec3d at = ground.min + Vec3d(random.within(0, 90), random.within(0, 90), 0);
    made.objects.add(block, {at, at + Vec3d(random.within(0, 10), random.within(0, 10), random.within(0, 30))},
                     kKinds[static_cast<std::size_t>(random.below(3))]);
  }
}

/// Blocks of no object, of one packet, of more; their objects are added in turns.
Made make_blocks(support::Random& random) {
  Made made;
  for (int b = 0; b < 30; ++b) {
    const Vec3d corner(random.within(-1000, 1000), random.within(-1000, 1000), 0);
    const culling::BoxD box{corner, corner + Vec3d(100, 100, 30)};
    made.blocks.push_back({Vec2d(corner), box, enclosing_sphere(box)});
  }
  for (int turn = 0; turn < 4; ++turn)
    for (std::uint32_t b = 1; b < made.blocks.size(); ++b) add_objects(made, random, b, random.below(b % 2 ? 8 : 100));
  made.built = build_tree(made.blocks, made.objects);
  return made;
}

}  // namespace

TEST_CASE("layers: within a block objects keep the order of their numbers") {
  support::Random random(51);
  const auto [blocks, objects, built] = make_blocks(random);
  REQUIRE(built.numbers.size() == objects.blocks.size());
  CHECK(std::set(built.numbers.begin(), built.numbers.end()).size() == objects.blocks.size());
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    const auto [first, last] = built.tree.block_objects[b];
    CHECK(std::is_sorted(built.numbers.begin() + first, built.numbers.begin() + last));
    for (std::uint32_t i = first; i < last; ++i) {
      REQUIRE(objects.blocks[built.numbers[i]] == built.tree.order[b]);
      REQUIRE(built.tree.classes[i] == objects.classes[built.numbers[i]]);
    }
  }
}

TEST_CASE("layers: a run of the tree is a run of rows of every layer") {
  support::Random random(52);
  const auto [blocks, objects, built] = make_blocks(random);
  std::uint32_t rows = 0;
  for (const ObjectClass kind : kKinds) {
    const LayerTable table = make_table(built, objects, kind);
    const std::vector<std::uint32_t> numbers = numbers_of(built, kind);
    rows += table.size();
    REQUIRE(table.row_first.size() == built.numbers.size() + 1);
    REQUIRE(table.size() == numbers.size());
    REQUIRE(table.row_first.back() == table.size());
    for (std::uint32_t i = 0; i < built.numbers.size(); ++i) {
      const auto [first, last] = table.rows({i, i + 1});
      REQUIRE(last - first == (objects.classes[built.numbers[i]] == kind ? 1 : 0));
      if (first == last) continue;
      REQUIRE(numbers[first] == built.numbers[i]);
      const culling::Box& box = table.boxes[first];
      const culling::BoxD& exact = objects.boxes[numbers[first]];
      REQUIRE(glm::all(glm::lessThanEqual(Vec3d(box.min) + built.tree.origin, exact.min)));
      REQUIRE(glm::all(glm::greaterThanEqual(Vec3d(box.max) + built.tree.origin, exact.max)));
    }
    const std::array<culling::ObjectRun, 2> halves{{{0, 100}, {100, built.tree.objects()}}};
    CHECK(count(table, halves) == table.size());
    CHECK(count(table, std::span(halves).first(1)) == table.row_first[100]);
  }
  CHECK(rows == built.tree.objects());
}

}  // namespace manzana
