// The query as a whole against the exact answer object by object, by every kind of vectors; and that it allocates
// nothing.
#include "culling/cull.h"

#include <iostream>
#include <map>

#include "tests/culling/allocations.h"
#include "tests/culling/polytope.h"
#include "tests/culling/scene.h"

namespace manzana::culling::test {
namespace {

constexpr int kFrames = 60;
constexpr double kEndless = std::numeric_limits<double>::infinity();

View frame(const City& city, int i) {
  return baselines::flight(city, i % 2 == 0 ? kEndless : 900, i / (kFrames - 1.0));
}

/// Those that lie outside no plane, exactly: what any test of single planes must take.
std::uint64_t by_planes(const Scene& s, const View& view) {
  const Polytope body = make_polytope(view);
  const auto kept = [&](const BoxD& box) {
    return std::none_of(body.planes.begin(), body.planes.end(), [&](const PlaneL& p) {
      const Vec3l corner = glm::mix(Vec3l(box.min), Vec3l(box.max), glm::greaterThan(p.normal, Vec3l(0)));
      return glm::dot(p.normal, corner - Vec3l(view.eye)) + p.offset < 0;
    });
  };
  return static_cast<std::uint64_t>(std::count_if(s.boxes.begin(), s.boxes.end(), kept));
}

/// Sums over frames.
struct Tally {
  std::uint64_t truly = 0, taken = 0, lost = 0, differ = 0;
  double worst = 1;
  void add(const std::vector<bool>& exact, const std::vector<bool>& seen, const std::vector<bool>& first) {
    for (std::size_t i = 0; i < seen.size(); ++i) lost += exact[i] && !seen[i] ? 1U : 0U;
    truly += count(exact);
    taken += count(seen);
    differ += differing(seen, first);
    if (count(exact) > 0) worst = std::max(worst, static_cast<double>(count(seen)) / static_cast<double>(count(exact)));
  }
};

TEST_CASE("no object that is seen is lost, and few others are taken") {
  std::map<std::string, Tally> by_target;
  std::vector<std::string> names;  // the widest vectors first
  std::uint64_t planes = 0, truly = 0;
  for (const Vec3d& place : eyes()) {
    const Scene s = city_10k(place);
    Answer answer(s.tree);
    for (int i = 0; i < kFrames; ++i) {
      const View view = frame(s.city, i);
      const auto exact = exactly_visible(view, s.boxes);
      planes += by_planes(s, view);
      truly += count(exact);
      std::vector<bool> first;
      on_each_target([&](const char* name) {
        REQUIRE(simd_target() == std::string(name));
        cull(s.tree, planes_of(s, view), answer);
        const auto seen = seen_objects(s, answer);
        if (first.empty()) first = seen;
        by_target[name].add(exact, seen, first);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
      });
    }
  }
  std::cout << "planes, exactly: accepted/exact " << static_cast<double>(planes) / static_cast<double>(truly) << '\n';
  for (const std::string& name : names) {
    const Tally& t = by_target[name];
    const double ratio = static_cast<double>(t.taken) / static_cast<double>(t.truly);
    std::cout << name << ": accepted/exact " << ratio << " over all frames, " << t.worst << " at worst; " << t.differ
              << " of " << t.taken << " objects otherwise than by " << names.front() << '\n';
    INFO(name);
    CHECK(t.lost == 0);
    CHECK(ratio <= 1.001);
    CHECK(t.worst <= 1.05);  // a frame may see only a few dozen objects
    CHECK(t.differ < t.taken / 10'000);
  }
}

/// Farthest out of any plane that a taken object lies, in steps of the lattice of its block's node.
Real farthest_out(const Scene& s, const View& view, const std::vector<bool>& seen) {
  const Polytope body = make_polytope(view);
  Real most = 0;
  for (std::uint32_t block = 0; block < s.tree.blocks(); ++block)
    for (std::uint32_t i = s.tree.block_objects[block].first; i < s.tree.block_objects[block].last; ++i)
      for (const PlaneL& p : body.planes) {
        if (!seen[i]) continue;
        const Vec3l low(s.boxes[i].min), high(s.boxes[i].max), eye(view.eye);
        const Vec3l corner = glm::mix(low, high, glm::greaterThan(p.normal, Vec3l(0)));
        const Real out = -(glm::dot(p.normal, corner - eye) + p.offset);
        most = std::max(most, out / static_cast<Real>(s.tree.nodes[s.tree.place[block] / kLanes].step));
      }
  return most;
}

bool wholly_inside(const Polytope& body, const Vec3d& eye, const BoxD& box) {
  for (const PlaneL& p : body.planes) {
    const Vec3l corner = glm::mix(Vec3l(box.max), Vec3l(box.min), glm::greaterThan(p.normal, Vec3l(0)));
    if (glm::dot(p.normal, corner - Vec3l(eye)) + p.offset < -1e-9L) return false;
  }
  return true;
}

void check_blocks(const Scene& s, const View& view, const Answer& answer, const std::vector<bool>& seen) {
  const auto listed = flags(answer.blocks(), s.tree.blocks());
  for (std::uint32_t b = 0; b < s.tree.blocks(); ++b)
    for (std::uint32_t i = s.tree.block_objects[b].first; i < s.tree.block_objects[b].last; ++i)
      if (!listed[b]) REQUIRE_FALSE(seen[i]);
  const Polytope body = make_polytope(view);
  for (const LeafRun& run : answer.blocks()) {
    if (!run.inside()) {
      REQUIRE(run.last == run.first + 1);
      continue;
    }
    for (std::uint32_t i = s.tree.block_objects[run.first].first; i < s.tree.block_objects[run.last - 1].last; ++i) {
      REQUIRE(seen[i]);
      REQUIRE(wholly_inside(body, view.eye, s.boxes[i]));
    }
  }
}

void check_ordered(const Scene& s, Answer& answer, const std::vector<bool>& seen) {
  const auto runs = ordered(answer);
  for (std::size_t i = 1; i < runs.size(); ++i) REQUIRE(runs[i].first > runs[i - 1].last);  // neighbours are joined
  REQUIRE(flags(runs, s.boxes.size()) == seen);
  REQUIRE(runs.data() == answer.objects().data());
  REQUIRE(count(runs) == count(seen));
}

TEST_CASE("cameras of all sorts: objects, blocks and runs are as they must be") {
  Random random(61);
  Real out = 0;
  std::uint64_t visible = 0, asked = 0;
  for (const Vec3d& place : eyes()) {
    const Scene s = make_scene(moved(baselines::make_city(4000, 7), place));
    Answer answer(s.tree), plain(s.tree);
    for (int i = 0; i < 300; ++i) {
      const View view = random_view(random, place + random.direction() * random.in(0, 1200));
      const auto exact = exactly_visible(view, s.boxes);
      INFO("seed 61, frame " << i);
      on_each_target([&](const char*) {
        cull(s.tree, planes_of(s, view), answer, {.blocks = true});
        const auto seen = seen_objects(s, answer);
        REQUIRE(std::equal(exact.begin(), exact.end(), seen.begin(), std::less_equal<>()));
        out = std::max(out, farthest_out(s, view, seen));
        check_blocks(s, view, answer, seen);
        cull(s.tree, planes_of(s, view), plain);
        REQUIRE(seen_objects(s, plain) == seen);
        REQUIRE(plain.blocks().empty());
        check_ordered(s, answer, seen);
        visible += count(seen);
        asked += seen.size();
      });
    }
  }
  std::cout << "taken, but outside a plane: by up to " << out << " steps\n";
  CHECK(out < 13.1 * 65536 / 37800 + 0.1);  // lanes_test.cpp
  CHECK(visible > 10'000);
  CHECK(visible < asked / 2);
}

TEST_CASE("everything seen: one run, one node, nothing seen: none, no tree: nothing") {
  const Scene s = city_10k();
  Answer answer(s.tree);
  CullStats stats =
      cull(s.tree, planes_of(s, look({0, 0, 1e5}, {0, 0, -1}, {0, 1, 0}, 1, 1)), answer, {.blocks = true});
  REQUIRE(answer.objects().size() == 1);
  CHECK(answer.objects()[0] == ObjectRun{0, s.tree.objects()});
  REQUIRE(answer.blocks().size() == 1);
  CHECK(answer.blocks()[0].inside());
  CHECK(answer.blocks()[0].last == s.tree.blocks());
  CHECK(stats.nodes == 1);
  CHECK(stats.packets == 0);
  const View away = look({0, 0, 1e5}, {0, 0, 1}, {0, 1, 0}, 1, 1);
  stats = cull(s.tree, planes_of(s, away), answer, {.blocks = true});
  CHECK(answer.objects().empty());
  CHECK(answer.blocks().empty());
  CHECK(ordered(answer).empty());
  CHECK(stats.nodes == 1);
  const BqrTree nothing;
  CHECK(cull(nothing, make_planes(nothing, make_frustum(away)), answer).nodes == 0);
  CHECK(answer.objects().empty());
}

TEST_CASE("blocks without objects give no runs of objects") {
  const City full = baselines::make_city(10'000, 1);
  for (const bool every : {true, false}) {
    City city = full;
    city.first = {0};
    city.boxes.clear();
    for (std::size_t b = 0; b < full.blocks.size(); ++b) {
      for (std::uint32_t i = full.first[b]; i < full.first[b + 1] && !every && b % 2 == 0; ++i)
        city.boxes.push_back(full.boxes[i]);
      city.first.push_back(city.objects());
    }
    const Scene s = make_scene(std::move(city));
    Answer answer(s.tree);
    std::uint64_t blocks = 0;
    on_each_target([&](const char*) {
      for (int i = 0; i < kFrames; ++i) {
        const View view = frame(full, i);
        cull(s.tree, planes_of(s, view), answer, {.blocks = true});
        REQUIRE(answer.objects().size() <= s.boxes.size());
        const auto seen = seen_objects(s, answer), exact = exactly_visible(view, s.boxes);
        REQUIRE(std::equal(exact.begin(), exact.end(), seen.begin(), std::less_equal<>()));
        blocks += count(flags(answer.blocks(), s.tree.blocks()));
      }
    });
    CHECK(blocks > 10'000);
  }
}

TEST_CASE("a frustum without planes, or with a NaN, takes everything") {
  const Scene s = city_10k();
  Answer answer(s.tree);
  FrustumD none, broken = make_frustum(look(Vec3d(0), {0, 1, 0}, {0, 0, 1}, 1, 1));
  none.planes.fill(kNoPlane);
  none.count = 6;
  broken.eye.y = std::numeric_limits<double>::quiet_NaN();
  on_each_target([&](const char*) {
    for (const FrustumD& f : {FrustumD{}, none, broken}) {
      cull(s.tree, make_planes(s.tree, f), answer);
      CHECK(count(answer.objects()) == s.tree.objects());
    }
  });
}

/// Blocks taken against blocks whose box is truly seen, low houses and towers [numerics 2.5: at most 2 %].
TEST_CASE("few blocks are taken that are not seen") {
  for (const double height : {20.0, 130.0}) {
    City city;
    Random random(62);
    for (int i = 0; i < 4096; ++i) {
      const Vec3d c = Vec3d{i % 64 * 100.0 + random.in(-9, 9), i / 64 * 100.0 + random.in(-9, 9), 0} - 3200.0;
      const BoxD box{c * Vec3d(1, 1, 0), c * Vec3d(1, 1, 0) + Vec3d(80, 80, height * random.in(0.4, 1.6))};
      city.blocks.push_back({Vec2d(c) + 40.0, box, enclosing_sphere(box)});
      city.boxes.push_back(box);
      city.first.push_back(static_cast<std::uint32_t>(city.boxes.size()));
    }
    const Scene s = make_scene(std::move(city));
    Answer answer(s.tree);
    double taken = 0, truly = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec3d eye{random.in(-3000, 3000), random.in(-3000, 3000), i % 2 == 0 ? 1.7 : random.in(50, 350)};
      const double a = random.in(-3.14, 3.14), pitch = i % 2 == 0 ? 0 : random.in(-0.8, 0);
      const View view = look(eye, {std::cos(a), std::sin(a), std::tan(pitch)}, {0, 0, 1}, 1.047, 16.0 / 9);
      cull(s.tree, planes_of(s, view), answer, {.blocks = true});
      taken += static_cast<double>(count(flags(answer.blocks(), s.tree.blocks())));
      truly += static_cast<double>(count(exactly_visible(view, s.boxes)));
    }
    std::cout << "blocks of " << height << " m: accepted/exact " << taken / truly << '\n';
    CHECK(taken / truly <= 1.02);
    CHECK(taken >= truly);
  }
}

TEST_CASE("a query allocates nothing") {
  const Scene s = city_10k();
  std::vector<Planes> planes;
  for (int i = 0; i < kFrames; ++i) planes.push_back(planes_of(s, frame(s.city, i)));
  std::array<Answer, kMaxViews> answers;
  for (Answer& answer : answers) answer.reserve(s.tree);
  cull(s.tree, planes[0], answers[0]);  // the kind of vectors is chosen
  const std::size_t before = allocations();
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i + kMaxViews <= planes.size(); ++i) {
    cull(s.tree, planes[i], answers[0], {.classes = 5, .blocks = true});
    seen += count(ordered(answers[0]));
    cull(s.tree, std::span(&planes[i], kMaxViews), answers, {.blocks = true});
    seen += count(answers[3].objects());
  }
  const std::size_t after = allocations();
  CHECK(before > 0);
  CHECK(after == before);
  CHECK(seen > 10'000);
}

}  // namespace
}  // namespace manzana::culling::test
