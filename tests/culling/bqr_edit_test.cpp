// Edits: whatever comes and goes, in any order, queries answer as if by brute force and the tree stays true.
#include "culling/bqr_edit.h"

#include <cstring>
#include <iostream>

#include "tests/culling/edited_city.h"
#include "tests/culling/polytope.h"

namespace manzana::culling::test {
namespace {

/// A block round a middle, with n objects anywhere in it; its ball is about the box, or about the objects.
NewBlock new_block(Random& random, const Vec3d& middle, const Vec3d& half, std::uint64_t n, bool classified) {
  NewBlock b;
  BoxD all{middle, middle};
  std::vector<SphereD> balls{{middle, 0}};
  for (std::uint64_t i = 0; i < n; ++i) {
    const Vec3d at = middle + half * Vec3d{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    const Vec3d size = half * random.scale(1e-4, 0.5) * (random.chance(0.1) ? 0.0 : 1.0);
    b.boxes.push_back({at - size, at + size});
    balls.push_back(enclosing_sphere(b.boxes.back()));
    all = merge(all, b.boxes.back());
    if (classified) b.classes.push_back(static_cast<ClassMask>(1U << random.below(5)));
  }
  b.volume = {Vec2d(middle), all, random.chance(0.5) ? enclosing_sphere(all) : enclosing_sphere(balls),
              static_cast<ClassMask>(random.chance(0.2) ? 0x8000 : 0)};
  return b;
}

Vec3d any_place(Random& random, const Vec3d& city) {
  const double far = random.chance(0.03) ? 1e7 : random.chance(0.1) ? 1e4 : 500;
  return city + Vec3d{random.in(-far, far), random.in(-far, far), random.in(-20, 20)};
}

double any_half(Random& random) {
  if (random.chance(0.04)) return random.scale(1e3, 1e7);
  if (random.chance(0.1)) return random.chance(0.5) ? 0 : 1e-9;
  return random.scale(5, 100);
}

NewBlock any_block(Random& random, const Vec3d& city, bool classified) {
  constexpr std::array<std::uint64_t, 8> kCounts{0, 1, 8, 20, 32, 33, 70, 300};
  const std::uint64_t n = random.chance(0.01) ? 2000 : kCounts[random.below(kCounts.size())];
  const Vec3d half{any_half(random)};
  return new_block(random, any_place(random, city), half * Vec3d(1, 1, random.in(0, 1)), n, classified);
}

void any_edit(EditedCity& e, Random& random, const Vec3d& city, bool classified) {
  const std::vector<std::uint32_t> living = e.living();
  const double what = random.unit();
  if (living.empty() || what < 0.45) return e.insert(any_block(random, city, classified));
  const std::uint32_t block = living[random.below(living.size())];
  if (what < 0.7) return e.remove(block);
  e.change(block, any_block(random, city, classified));
}

/// A flag a row of the lists.
std::vector<bool> rows_of(const EditedCity& e, const Answer& answer) {
  const std::vector<bool> seen = flags(answer.objects(), e.tree.objects());
  std::vector<bool> rows(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) rows[e.tree.object_order[i]] = seen[i];
  return rows;
}

/// Blocks that are inside hold only what is taken; those that are not there are not listed.
std::vector<bool> listed(const EditedCity& e, const Answer& answer, const std::vector<bool>& rows) {
  const std::vector<bool> blocks = flags(answer.blocks(), e.blocks.size());
  for (std::uint32_t b = 0; b < blocks.size(); ++b) REQUIRE((e.blocks[b].there || !blocks[b]));
  for (const LeafRun& run : answer.blocks())
    for (std::uint32_t b = run.first; run.inside() && b < run.last; ++b)
      for (std::uint32_t i = e.blocks[b].first; i < e.blocks[b].last; ++i) REQUIRE(rows[i]);
  return blocks;
}

/// Nothing lost, nothing that is gone, and every object's block is listed.
std::vector<bool> check_one(const EditedCity& e, const View& view, const Planes& planes, Answer& answer) {
  cull(e.tree, planes, answer, {.blocks = true});
  const std::vector<bool> rows = rows_of(e, answer), exact = exactly_visible(view, e.boxes),
                          blocks = listed(e, answer, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) REQUIRE((rows[i] ? e.there[i] : !(exact[i] && e.there[i])));
  for (std::uint32_t b = 0; b < blocks.size(); ++b)
    for (std::uint32_t i = e.blocks[b].first; i < e.blocks[b].last; ++i) REQUIRE((!rows[i] || blocks[b]));
  return rows;
}

void check_filter(const EditedCity& e, const Planes& planes, std::vector<bool> rows, ClassMask mask) {
  Answer answer;
  cull(e.tree, planes, answer, {.classes = mask});
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = rows[i] && (e.classes[i] & mask) != 0;
  REQUIRE(rows_of(e, answer) == rows);
}

View any_view(Random& random, const Vec3d& city) {
  if (random.chance(0.1)) return look(city + Vec3d(0, 0, 1e8), {0, 0, -1}, {0, 1, 0}, 2, 1);  // takes everything
  return random_view(random, city + random.direction() * random.in(0, 1000));
}

/// Several views at once take what each alone does; the sum of what is taken.
std::uint64_t check_queries(const EditedCity& e, Random& random, const Vec3d& city) {
  constexpr std::size_t kViews = 4;
  std::vector<Planes> planes;
  std::vector<std::vector<bool>> rows;
  Answer answer;
  for (std::size_t v = 0; v < kViews; ++v) {
    const View view = any_view(random, city);
    planes.push_back(make_planes(e.tree, make_frustum(view)));
    rows.push_back(check_one(e, view, planes[v], answer));
    check_filter(e, planes[v], rows[v], static_cast<ClassMask>(random.below(0x10000)));
  }
  std::array<Answer, kViews> answers;
  cull(e.tree, planes, answers);
  std::uint64_t taken = 0;
  for (std::size_t v = 0; v < kViews; ++v) {
    REQUIRE(rows_of(e, answers[v]) == rows[v]);
    taken += count(rows[v]);
  }
  return taken;
}

std::uint64_t check(const EditedCity& e, Random& random, const Vec3d& city) {
  EditChecks(e).run();
  return check_queries(e, random, city);
}

/// `classified(edit)`: whether the blocks of that edit have classes.
template <class F>
void edit_often(EditedCity e, std::uint64_t seed, const Vec3d& city, int edits, F classified) {
  Random random(seed);
  std::uint64_t taken = 0;
  for (int i = 0; i < edits; ++i) {
    INFO("seed " << seed << ", edit " << i);
    any_edit(e, random, city, classified(i));
    if (i < 20 || i % 10 == 0) taken += check(e, random, city);
  }
  CHECK(taken > 1000);
}

std::vector<ClassMask> any_classes(Random& random, std::uint32_t n) {
  std::vector<ClassMask> classes;
  for (std::uint32_t i = 0; i < n; ++i) classes.push_back(static_cast<ClassMask>(1U << random.below(5)));
  return classes;
}

TEST_CASE("edits: from nothing") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    edit_often({}, seed, Vec3d(0), 200, [](int) { return false; });
    edit_often({}, seed, eyes().back(), 200, [](int) { return true; });
  }
}

TEST_CASE("edits: of a city without classes, into which classes come") {
  const Vec3d place{676000.4, 4613000.7, 201.3};
  edit_often(edited(moved(baselines::make_city(2000, 3), place)), 11, place, 300, [](int i) { return i > 40; });
  edit_often(edited(baselines::make_city(500, 4)), 12, Vec3d(0), 300, [](int i) { return i % 50 == 49; });
}

TEST_CASE("edits: of a city with classes, into which blocks without them come") {
  Random random(21);
  const City city = baselines::make_city(2000, 5);
  edit_often(edited(city, any_classes(random, city.objects())), 22, Vec3d(0), 300, [](int i) { return i % 3 != 0; });
}

TEST_CASE("edits: by every kind of vectors") {
  Random random(31);
  EditedCity e = edited(baselines::make_city(1000, 6));
  for (int i = 0; i < 100; ++i) any_edit(e, random, Vec3d(0), i > 50);
  on_each_target([&](const char*) {
    for (int i = 0; i < 10; ++i) check(e, random, Vec3d(0));
  });
}

TEST_CASE("edits: all is removed, and comes again") {
  for (const std::uint32_t objects : {25U, 300U, 3000U}) {
    INFO("seed 41, " << objects << " objects");
    Random random(41);
    EditedCity e = edited(baselines::make_city(objects, 7));
    for (int round = 0; round < 3; ++round) {
      for (const std::uint32_t b : e.living()) e.remove(b);
      REQUIRE(check(e, random, Vec3d(0)) == 0);
      e.remove(0);  // it is gone already
      e.insert(any_block(random, Vec3d(round == 0 ? 1e7 : 0), false));
      e.change(0, any_block(random, Vec3d(0), false));  // a number that is unused
      for (int i = 0; i < 40; ++i) e.insert(any_block(random, Vec3d(0), false));
      check(e, random, Vec3d(0));
    }
  }
}

TEST_CASE("edits: the first block of a tree, of any number of objects") {
  Random random(51);
  for (const std::uint64_t n : {0, 1, 33, 2000})
    for (const double half : {0.0, 1e-9, 50.0, 1e7}) {
      INFO("seed 51, " << n << " objects, " << half << " m");
      EditedCity e;
      e.insert(new_block(random, {1e6, 2, 3}, Vec3d(half), n, n == 33));
      check(e, random, {1e6, 2, 3});
      CHECK(e.tree.nodes.size() == 1);
      e.remove(0);
      check(e, random, {1e6, 2, 3});
    }
}

TEST_CASE("edits: a block that moves on and on leaves no more nodes than places") {
  Random random(61);
  EditedCity e;
  e.insert(any_block(random, Vec3d(0), false));
  for (int i = 0; i < 100; ++i) e.change(0, new_block(random, Vec3d(i * 1e5, 0, 0), Vec3d(40), 3, false));
  check(e, random, {99e5, 0, 0});
  CHECK(e.tree.nodes.size() < 10);
}

TEST_CASE("edits: blocks that move in their own room") {
  for (const std::uint64_t seed : {63, 64, 65}) {
    Random random(seed);
    const City city = baselines::make_city(1000, seed);
    EditedCity e = seed == 63 ? edited(city) : edited(city, any_classes(random, city.objects()));
    std::uint64_t taken = 0;
    for (int i = 0; i < 300; ++i) {
      INFO("seed " << seed << ", edit " << i);
      const std::vector<std::uint32_t> living = e.living();
      const std::uint32_t block = living[random.below(living.size())];
      const std::uint32_t objects = e.blocks[block].last - e.blocks[block].first;
      if (i % 5 == 4)
        any_edit(e, random, Vec3d(0), i % 2 == 0);
      else
        e.move(block, new_block(random, any_place(random, Vec3d(0)), Vec3d(any_half(random)), objects, i > 100));
      if (i % 10 == 0) taken += check(e, random, Vec3d(0));
    }
    CHECK(taken > 1000);
  }
}

TEST_CASE("edits: other classes for all") {
  for (const std::uint64_t seed : {67, 68}) {
    Random random(seed);
    const City city = baselines::make_city(1000, seed);
    EditedCity e = seed == 67 ? edited(city) : edited(city, any_classes(random, city.objects()));
    for (int round = 0; round < 5; ++round) {
      INFO("seed " << seed << ", round " << round);
      for (int i = 0; i < 20; ++i) any_edit(e, random, Vec3d(0), i % 2 == 0);
      const std::vector<ClassMask> classes = any_classes(random, e.tree.objects());
      std::vector<ClassMask> besides;
      for (const EditedCity::Block& block : e.blocks) besides.push_back(block.volume.classes);
      set_classes(e.tree, classes, besides);
      for (std::uint32_t i = 0; i < classes.size(); ++i) e.classes[e.tree.object_order[i]] = classes[i];
      check(e, random, Vec3d(0));
    }
  }
}

TEST_CASE("edits: moves without end take no memory and leave no wide boxes behind") {
  Random random(66);
  EditedCity e;
  for (int i = 0; i < 200; ++i) e.insert(new_block(random, any_place(random, Vec3d(0)), Vec3d(3), 1, false));
  std::size_t nodes = 0;
  for (int round = 0; round < 50; ++round) {
    for (std::uint32_t b = 0; b < 200; ++b)
      e.move(b, new_block(random, Vec3d(random.in(-500, 500), random.in(-500, 500), 0), Vec3d(3), 1, false));
    if (round == 5) nodes = e.tree.nodes.size();
  }
  check(e, random, Vec3d(0));
  CHECK(e.tree.nodes.size() <= nodes + 8);
  const BqrTree anew = built_anew(e);
  Answer a(e.tree), b(anew);
  CullStats edited_stats, anew_stats;
  for (int i = 0; i < 100; ++i) {
    const FrustumD frustum = make_frustum(any_view(random, Vec3d(0)));
    edited_stats.nodes += cull(e.tree, make_planes(e.tree, frustum), a).nodes;
    anew_stats.nodes += cull(anew, make_planes(anew, frustum), b).nodes;
  }
  std::cout << "seed 66: " << e.tree.nodes.size() << " nodes after 10000 moves, built anew " << anew.nodes.size()
            << "; tested in 100 views " << edited_stats.nodes << " and " << anew_stats.nodes << '\n';
  CHECK(edited_stats.nodes < 8 * anew_stats.nodes);
}

TEST_CASE("edits: blocks as far away as can be") {
  Random random(62);
  EditedCity e = edited(baselines::make_city(500, 10));
  for (const double far : {1e20, 9e36, -9e36}) {
    INFO("seed 62, " << far << " m");
    e.insert(new_block(random, {far, -far, far / 2}, Vec3d(std::abs(far) / 20), 40, true));
    for (int i = 0; i < 40; ++i) e.insert(new_block(random, any_place(random, Vec3d(0)), Vec3d(30), 3, false));
    check(e, random, Vec3d(0));
  }
}

TEST_CASE("edits: a tree grown block by block is not a list") {
  const City city = baselines::make_city(20'000, 8);
  BqrTree tree;
  for (std::uint32_t b = 0; b < city.blocks.size(); ++b)
    insert_block(tree, city.blocks[b],
                 {std::span(city.boxes).subspan(city.first[b], city.first[b + 1] - city.first[b]), {}});
  std::uint32_t deepest = 0;
  for (const std::uint32_t place : tree.place) {
    std::uint32_t depth = 0;
    for (std::uint32_t at = place / kLanes; at != tree.root; at = tree.nodes[at].parent) ++depth;
    deepest = std::max(deepest, depth);
  }
  std::cout << city.blocks.size() << " blocks inserted one by one: " << tree.nodes.size() << " nodes, " << deepest + 1
            << " levels\n";
  CHECK(deepest < 10);
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
bool same(const BqrTree& a, const BqrTree& b) {
  return a.origin == b.origin && a.reach == b.reach && a.root == b.root && same(a.nodes, b.nodes) &&
         same(a.packets, b.packets) && same(a.classes, b.classes) && same(a.block_objects, b.block_objects) &&
         same(a.place, b.place) && same(a.order, b.order) && same(a.object_order, b.object_order) &&
         same(a.spare, b.spare);
}

/// By an insertion as block `blocks()`, and by a change of block 3; objects from `objects()`.
void check_refused(BqrTree tree, const NewBlock& bad, const std::string& of_inserted, const std::string& of_changed) {
  const BqrTree before = tree;
  REQUIRE_THROWS_AS(insert_block(tree, bad.volume, bad.objects()), std::invalid_argument);
  REQUIRE_THROWS_WITH(insert_block(tree, bad.volume, bad.objects()), Catch::StartsWith(of_inserted + ":"));
  REQUIRE_THROWS_WITH(change_block(tree, 3, bad.volume, bad.objects()), Catch::StartsWith(of_changed + ":"));
  REQUIRE(same(tree, before));
}

TEST_CASE("edits: bad input is refused by its index, and nothing has changed") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Random random(71);
  const NewBlock good = new_block(random, Vec3d(0), Vec3d(40), 50, true);
  const City city = baselines::make_city(1000, 9);
  const std::vector<ClassMask> classes = any_classes(random, city.objects());
  for (const bool classified : {false, true}) {
    const EditedCity e = classified ? edited(city, classes) : edited(city);
    const std::string inserted = "block " + std::to_string(e.tree.blocks()),
                      object = "object " + std::to_string(e.tree.objects() + 17);
    const auto block_refused = [&](auto change) {
      NewBlock bad = good;
      change(bad.volume);
      check_refused(e.tree, bad, inserted, "block 3");
    };
    const auto object_refused = [&](auto change) {
      NewBlock bad = good;
      change(bad.boxes[17], bad.classes[17]);
      check_refused(e.tree, bad, object, object);
    };
    block_refused([&](BlockVolume& v) { v.center.x = nan; });
    block_refused([&](BlockVolume& v) { v.box = {}; });
    block_refused([&](BlockVolume& v) { v.box.max.z = inf; });
    block_refused([&](BlockVolume& v) { v.box.min.x = -1.1e37; });
    block_refused([&](BlockVolume& v) { v.sphere = {}; });
    block_refused([&](BlockVolume& v) { v.sphere.center.y = nan; });
    block_refused([&](BlockVolume& v) { v.sphere.radius = inf; });
    object_refused([&](BoxD& b, ClassMask&) { b = {}; });
    object_refused([&](BoxD& b, ClassMask&) { b.min.y = nan; });
    object_refused([&](BoxD& b, ClassMask&) { b.max.x = good.volume.box.max.x + 1e-9; });
    object_refused([&](BoxD&, ClassMask& c) { c = 0; });
  }
}

}  // namespace
}  // namespace manzana::culling::test
