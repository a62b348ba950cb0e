// A query on all threads finds the very runs that it finds on one, takes the same work, and allocates nothing.
#include "culling/cull_parallel.h"

#include "tests/culling/allocations.h"
#include "tests/culling/classified_city.h"

namespace manzana::culling::test {
namespace {

std::vector<std::array<std::uint32_t, 2>> runs_of(const Answer& answer) {
  std::vector<std::array<std::uint32_t, 2>> runs;
  for (const ObjectRun& run : answer.objects()) runs.push_back({run.first, run.last});
  std::sort(runs.begin(), runs.end());
  return runs;
}
std::vector<std::array<std::uint32_t, 3>> blocks_of(const Answer& answer) {
  std::vector<std::array<std::uint32_t, 3>> runs;
  for (const LeafRun& run : answer.blocks()) runs.push_back({run.first, run.last, run.planes});
  std::sort(runs.begin(), runs.end());
  return runs;
}

void require_same(const Answer& one, const Answer& all) {
  REQUIRE(runs_of(one) == runs_of(all));
  REQUIRE(blocks_of(one) == blocks_of(all));
}
void require_same(const CullStats& one, const CullStats& all) {
  REQUIRE(one.nodes == all.nodes);
  REQUIRE(one.blocks == all.blocks);
  REQUIRE(one.packets == all.packets);
}

/// Level with the roofs: its lower side crosses every block that is between the other sides.
View along_the_roofs(const City& city, double degrees) {
  const Vec3d eye(city.bounds.min.x, center(city.bounds).y, 12);
  View view = look(eye, {1, 0, 0}, {0, 0, 1}, glm::radians(degrees), 1);
  view.tan_bottom = 0;
  return view;
}

}  // namespace

TEST_CASE("a shared query finds the runs and the blocks of a single one wherever it begins to be shared") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    const Scene s = classified(random);
    Answer one(s.tree), all(s.tree);
    Crew crew;
    for (int i = 0; i < 300; ++i) {
      const Planes planes = planes_of(s, any_view(s, random));
      const CullOptions options{.classes = any_mask(random), .blocks = random.chance(0.5)};
      crew.shared_above = static_cast<std::uint32_t>(random.below(12));
      const CullStats stats = cull(s.tree, planes, one, options);
      require_same(stats, cull_parallel(s.tree, planes, crew, all, options));
      require_same(one, all);
    }
    CHECK(!crew.members.empty());
  }
}

TEST_CASE("a shared query about several views finds what a single one does") {
  Random random(9);
  const Scene s = classified(random);
  std::array<Answer, kMaxViews> one, all;
  Crew crew;
  for (int i = 0; i < 200; ++i) {
    const std::size_t n = 1 + random.below(kMaxViews);
    std::vector<Planes> planes;
    for (std::size_t v = 0; v < n; ++v) planes.push_back(planes_of(s, any_view(s, random)));
    const CullOptions options{.classes = any_mask(random), .blocks = true};
    crew.shared_above = static_cast<std::uint32_t>(random.below(12));
    const CullStats stats = cull(s.tree, planes, std::span(one).first(n), options);
    require_same(stats, cull_parallel(s.tree, planes, crew, std::span(all).first(n), options));
    for (std::size_t v = 0; v < n; ++v) require_same(one[v], all[v]);
  }
}

TEST_CASE("by every kind of vectors a shared query finds the same as a single one") {
  const Scene s = city_10k();
  Crew crew{.shared_above = 3, .members = {}};
  Answer one(s.tree), all(s.tree);
  on_each_target([&](const char*) {
    for (const double degrees : {10.0, 60.0, 140.0}) {
      const Planes planes = planes_of(s, along_the_roofs(s.city, degrees));
      cull(s.tree, planes, one);
      cull_parallel(s.tree, planes, crew, all);
      require_same(one, all);
      CHECK(runs_of(one).size() > 20);
    }
  });
}

TEST_CASE("what visits little is not shared and what visits much is") {
  const Scene s = make_scene(baselines::make_city(200'000, 1));
  Answer one(s.tree), all(s.tree);
  Crew crew;
  for (int i = 0; i < 30; ++i) cull_parallel(s.tree, planes_of(s, baselines::flight(s.city, 1e9, i / 29.0)), crew, all);
  CHECK(crew.members.empty());
  const Planes planes = planes_of(s, along_the_roofs(s.city, 150));
  REQUIRE(cull(s.tree, planes, one).nodes > kSharedAbove);
  cull_parallel(s.tree, planes, crew, all);
  CHECK(!crew.members.empty());
  require_same(one, all);
}

TEST_CASE("an empty tree is nothing to share") {
  const BqrTree tree = build_bqr_tree({});
  Answer answer(tree);
  Crew crew{.shared_above = 0, .members = {}};
  CHECK(cull_parallel(tree, Planes{}, crew, answer).nodes == 0);
  CHECK(answer.objects().empty());
}

TEST_CASE("a shared query allocates nothing once one was shared") {
  const Scene s = city_10k();
  std::vector<Planes> planes;
  for (int i = 0; i < 40; ++i) planes.push_back(planes_of(s, along_the_roofs(s.city, 10 + 3 * i)));
  Answer answer(s.tree);
  Crew crew{.shared_above = 2, .members = {}};
  cull_parallel(s.tree, planes[0], crew, answer);
  const std::size_t before = allocations();
  std::uint64_t seen = 0;
  for (const Planes& p : planes) {
    cull_parallel(s.tree, p, crew, answer, {.classes = 5, .blocks = true});
    seen += count(answer.objects());
  }
  CHECK(allocations() == before);
  CHECK(seen > 10'000);
}

}  // namespace manzana::culling::test
