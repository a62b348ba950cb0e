// Objects as columns: packets and their ends against one box at a time; no allocation in a query.
#include "culling/object_table.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

#include "tests/culling/polytope.h"
#include "tests/culling/scene.h"

namespace {
std::size_t allocations = 0;
}
void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace manzana::culling::test {
namespace {

std::vector<BoxD> boxes_round(const Vec3d& place, std::uint32_t n, Random& random) {
  std::vector<BoxD> boxes;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3d c = place + random.direction() * random.in(0, 300), size = glm::abs(random.direction()) * 20.0;
    boxes.push_back({c - size, c + size});
  }
  return boxes;
}

TEST_CASE("packets answer as single boxes do, for any number of objects and blocks") {
  Random random(71);
  int visible = 0, hidden = 0;
  for (std::uint32_t n = 0; n <= 70; ++n) {
    const std::uint32_t a = static_cast<std::uint32_t>(random.below(n + 1));
    const std::uint32_t b = a + static_cast<std::uint32_t>(random.below(n - a + 1));
    const auto boxes = boxes_round(Vec3d(0), n, random);
    const ObjectTable table = build_object_table(Vec3d(0), boxes, {0, a, b, n});
    REQUIRE(table.size() == n);
    const View view = look(Vec3d(0), random.direction(), {0, 0, 1}, 1.5, 1.5, 1, 250);
    const Frustum frustum = narrow(make_frustum(view), Vec3d(0));
    std::vector<ObjectRun> runs;
    cull_objects(table, std::vector<LeafRun>{{0, 2, Overlap::crosses, 0xFF}, {2, 3, Overlap::crosses, 0xFF}}, frustum,
                 runs);
    const auto seen = flags(runs, n);
    for (std::uint32_t i = 0; i < n; ++i) {
      REQUIRE(seen[i] == (overlap(frustum, narrow(boxes[i], Vec3d(0))) != Overlap::outside));
      ++(seen[i] ? visible : hidden);
    }
  }
  CHECK(visible > 100);
  CHECK(hidden > 100);
}

TEST_CASE("objects of inside blocks are taken untested, of unmentioned ones not at all, neighbours merge") {
  Random random(72);
  const auto boxes = boxes_round(Vec3d(0, -5000, 0), 30, random);  // behind the camera, so any test would drop them
  const ObjectTable table = build_object_table(Vec3d(0), boxes, {0, 10, 10, 20, 30});
  const Frustum frustum = narrow(make_frustum(look(Vec3d(0), {0, 1, 0}, {0, 0, 1}, 1, 1)), Vec3d(0));
  std::vector<ObjectRun> runs{{5, 6}};
  cull_objects(table, std::vector<LeafRun>{{0, 1, Overlap::inside, 0}, {1, 3, Overlap::inside, 0}}, frustum, runs);
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].first == 0);
  CHECK(runs[0].last == 20);
  cull_objects(table, std::vector<LeafRun>{{0, 1, Overlap::crosses, 0xFF}, {1, 2, Overlap::inside, 0}}, frustum, runs);
  CHECK(runs.empty());
  cull_objects(table, {}, frustum, runs);
  CHECK(runs.empty());
}

TEST_CASE("only the planes that a block crosses are asked") {
  const std::vector<BoxD> boxes(9, BoxD{{-1, -50, -1}, {1, -49, 1}});
  const ObjectTable table = build_object_table(Vec3d(0), boxes, {0, 9});
  const Frustum frustum = narrow(make_frustum(look(Vec3d(0), {0, 1, 0}, {0, 0, 1}, 1, 1)), Vec3d(0));
  std::vector<ObjectRun> runs;
  cull_objects(table, std::vector<LeafRun>{{0, 1, Overlap::crosses, 0}}, frustum, runs);
  CHECK(count(runs) == 9);
  cull_objects(table, std::vector<LeafRun>{{0, 1, Overlap::crosses, 1U << kNear}}, frustum, runs);
  CHECK(count(runs) == 0);
}

TEST_CASE("take_all and count") {
  Random random(73);
  const ObjectTable table = build_object_table(Vec3d(0), boxes_round(Vec3d(0), 12, random), {0, 5, 12});
  std::vector<ObjectRun> runs;
  take_all(table, runs);
  REQUIRE(runs.size() == 1);
  CHECK(count(runs) == 12);
  take_all(build_object_table(Vec3d(0), {}, {0}), runs);
  CHECK(runs.empty());
  CHECK(count(std::vector<ObjectRun>(3, {0, 0xFFFFFFFF})) == 3 * std::uint64_t{0xFFFFFFFF});
}

TEST_CASE("a bad box is refused by its index") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const BoxD& bad : {BoxD{}, BoxD{{0, nan, 0}, {1, 1, 1}}, BoxD{{0, 0, 0}, {1, 1, inf}},
                          BoxD{{0, 0, 0}, {1, 1, 1e300}}, BoxD{{0, 2, 0}, {1, 1, 1}}}) {
    const std::vector<BoxD> boxes{{{0, 0, 0}, {1, 1, 1}}, bad};
    CHECK_THROWS_AS(build_object_table(Vec3d(0), boxes, {0, 2}), std::invalid_argument);
    CHECK_THROWS_WITH(build_object_table(Vec3d(0), boxes, {0, 2}), Catch::Contains("object 1:"));
  }
}

TEST_CASE("a table without its reach culls nothing") {
  ObjectTable table = build_object_table(Vec3d(0), std::vector<BoxD>(9, {{-1, -50, -1}, {1, -49, 1}}), {0, 9});
  table.reach = ObjectTable{}.reach;
  const Frustum frustum = narrow(make_frustum(look(Vec3d(0), {0, 1, 0}, {0, 0, 1}, 1, 1)), Vec3d(0));
  std::vector<ObjectRun> runs;
  cull_objects(table, std::vector<LeafRun>{{0, 1, Overlap::crosses, 0xFF}}, frustum, runs);
  CHECK(count(runs) == 9);
}

TEST_CASE("a query allocates nothing") {
  const Scene s = city_10k();
  Answer answer(s);
  const std::size_t before = allocations;
  std::uint64_t seen = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const Frustum frustum = frustum_of(s, pina_view(s.city, frame / 59.0));
    ask_blocks(s, frustum, answer);
    ask_objects(s, frustum, answer);
    seen += count(answer.objects);
  }
  const std::size_t after = allocations;
  CHECK(before > 0);
  CHECK(after == before);
  CHECK(seen > 10000);
}

}  // namespace
}  // namespace manzana::culling::test
