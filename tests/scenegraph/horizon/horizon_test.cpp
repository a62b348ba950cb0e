// What a horizon takes away is hidden, by rays to it and every triangle of what is left; and how much it takes away.
#include "scenegraph/horizon.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "scenegraph/classes.h"
#include "scenegraph/import/import.h"
#include "tests/scenegraph/horizon/rays.h"

namespace manzana {
namespace {

BuildingFeature box(const Vec2d& low, const Vec2d& high, double height, double min_height = 0) {
  BuildingFeature b;
  b.footprint.outer = {low, {high.x, low.y}, high, {low.x, high.y}};
  b.height = height;
  b.min_height = min_height;
  return b;
}

Scene scene_of(std::vector<BuildingFeature> buildings) {
  CityFeatures city;
  city.buildings = std::move(buildings);
  return build_scene(std::move(city), {.cars = 0}, {}).scene;
}

Vec2d middle_of(const Scene& scene, std::uint32_t row) {
  const culling::Box& b = scene.buildings.table.boxes[row];
  return glm::round(Vec2d(b.min + b.max) / 2.0 + Vec2d(scene.tree.origin));
}

std::vector<Vec2d> middles_of(const Scene& scene, std::span<const culling::ObjectRun> objects) {
  std::vector<Vec2d> middles;
  for (const culling::ObjectRun& run : objects) {
    const culling::ObjectRun rows = scene.buildings.table.rows(run);
    for (std::uint32_t row = rows.first; row < rows.last; ++row) middles.push_back(middle_of(scene, row));
  }
  return middles;
}

struct Asked {
  culling::ClassMask classes = culling::kAllClasses;
  double near_m = 0.1;
  Horizon::IsThere there = {};
};

/// From 1.7 m above the origin, to the north.
VisibleSets sets_of(const Scene& scene, const Asked& asked) {
  VisibleSets sets(scene);
  Horizon horizon(scene);
  sets.classes = asked.classes;
  const culling::View view = culling::look({0, 0, 1.7}, {0, 1, 0}, {0, 0, 1}, 1.5, 2, asked.near_m);
  find_visible(scene, view, Structure::bqr, sets);
  horizon.hide(scene, {view.eye, sets.frustum.planes[culling::kNear]}, sets);
  if (asked.there) horizon.reveal(scene, sets, asked.there);
  return sets;
}

/// Middles of the buildings that are seen.
std::vector<Vec2d> seen_of(const Scene& scene, const Asked& asked = {}) {
  return middles_of(scene, sets_of(scene, asked).objects());
}

bool holds(const std::vector<Vec2d>& all, const Vec2d& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

const Scene& town() {
  static const Imported city = import_city("builtin:town", {}, {});
  return city.scene;
}
const Scene& town_of_ten() {
  static const Imported city = import_city("builtin:town:10", {}, {});
  return city.scene;
}

Vec3d place_on_a_street(const Scene& scene, std::uint64_t number, double height) {
  const auto& points = scene.traffic.points;
  return Vec3d(points[number % points.size()].position) + Vec3d(0, 0, height);
}

}  // namespace

TEST_CASE("horizon: a building hides what is lower and farther and all of it behind") {
  const BuildingFeature front = box({-20, 20}, {20, 30}, 12);
  const Vec2d low(0, 105), tower(0, 205), beside(130, 105), near(10, 15), half(120, 125);
  const Scene scene =
      scene_of({front, box({-5, 100}, {5, 110}, 10), box({-5, 200}, {5, 210}, 200), box({125, 100}, {135, 110}, 10),
                box({9, 14}, {11, 16}, 3), box({105, 120}, {135, 130}, 10)});
  const auto seen = seen_of(scene);
  CHECK_FALSE(holds(seen, low));
  for (const Vec2d& place : {Vec2d(0, 25), tower, beside, near, half}) CHECK(holds(seen, place));
}

TEST_CASE("horizon: a building that stands on air hides nothing on the ground") {
  CHECK(holds(seen_of(scene_of({box({-20, 20}, {20, 30}, 12, 3), box({-5, 100}, {5, 110}, 10)})), {0, 105}));
}

TEST_CASE("horizon: what is not looked for hides nothing") {
  const Scene scene =
      scene_of({box({-20, 20}, {20, 30}, 12), box({-5, 100}, {5, 130}, 25), box({-5, 500}, {5, 510}, 22)});
  CHECK_FALSE(holds(seen_of(scene), {0, 505}));
  const auto high = seen_of(scene, {kBuildingOver20});
  CHECK(high.size() == 1);
  CHECK_FALSE(holds(seen_of(scene, {kBuildingOver20}), {0, 25}));
}

TEST_CASE("horizon: what a near plane cuts away hides nothing") {
  const Scene scene = scene_of({box({-20, 20}, {20, 30}, 12), box({-5, 100}, {5, 110}, 10)});
  CHECK_FALSE(holds(seen_of(scene, {.near_m = 19}), {0, 105}));
  CHECK(holds(seen_of(scene, {.near_m = 21}), {0, 105}));
  CHECK(holds(seen_of(scene, {.near_m = 40}), {0, 105}));
}

TEST_CASE("horizon: what is not on the device yet hides nothing but what it will hide is not brought") {
  const Scene scene =
      scene_of({box({-20, 20}, {20, 30}, 12), box({-5, 100}, {5, 110}, 10), box({-4, 200}, {4, 208}, 6)});
  const Vec2d front(0, 25), behind(0, 105), last(0, 204);
  const auto all_but = [&](const Vec2d& missing) {
    return sets_of(scene, {.there = [&scene, missing](std::uint32_t row) { return middle_of(scene, row) != missing; }});
  };
  const VisibleSets without_front = all_but(front);
  const auto drawn = middles_of(scene, without_front.objects()), brought = middles_of(scene, without_front.to_bring());
  CHECK(holds(drawn, front));
  CHECK(holds(drawn, behind));
  CHECK_FALSE(holds(drawn, last));  // the one in the middle is there
  CHECK(brought == std::vector<Vec2d>{front});
  const VisibleSets without_last = all_but(last);
  CHECK(middles_of(scene, without_last.objects()) == std::vector<Vec2d>{front});
  CHECK(middles_of(scene, without_last.to_bring()) == std::vector<Vec2d>{front});
}

TEST_CASE("horizon: walls that continue each other leave no gap between them") {
  std::vector<BuildingFeature> all{box({-3, 300}, {3, 306}, 5)};
  BuildingFeature round;
  for (int i = 0; i < 60; ++i) {
    const double a = 2 * 3.14159265358979 * i / 60;
    round.footprint.outer.push_back({20 * std::cos(a), 60 + 20 * std::sin(a)});
  }
  round.height = 30;
  all.push_back(round);
  CHECK_FALSE(holds(seen_of(scene_of(all)), {0, 303}));
}

TEST_CASE("horizon: no ray reaches what was taken away") {
  support::Random random(3);
  Taken taken;
  for (const Scene* scene : {&town(), &town_of_ten()}) {
    std::vector<Vec3d> eyes;
    for (int n = 0; n < 12; ++n) eyes.push_back(place_on_a_street(*scene, random.bits(), n % 4 == 3 ? 14 : 1.7));
    taken += check_by_rays(*scene, eyes, random);
  }
  CHECK(taken.gone > 5000);
  CHECK(taken.rays > 2000);
}

// The frame's up is not theirs: walls lean by a thirtieth.
TEST_CASE("horizon: no ray reaches what was taken away far from the middle of the frame") {
  support::Random random(8);
  std::vector<BuildingFeature> houses;
  constexpr double kFar = 200'000;
  for (int i = 0; i < 900; ++i) {
    const Vec2d low(kFar + 16 * (i % 30) + random.within(0, 2), 16 * (i / 30) + random.within(0, 2));
    houses.push_back(box(low, low + Vec2d(random.within(8, 12), random.within(8, 12)), random.within(4, 60)));
  }
  const Scene scene = scene_of(std::move(houses));
  std::vector<Vec3d> eyes;
  for (int i = 0; i < 40; ++i) {
    const Vec2d at(kFar + 16 * random.below(30) - 1.5, random.within(0, 480));
    eyes.emplace_back(at, scene.frame.ground_z(at) + random.within(1, 20));
  }
  const Taken taken = check_by_rays(scene, eyes, random);
  CHECK(taken.gone > 1000);
}

// The same corner in a town ten times as large: what is brought and submitted, over eight ways of looking.
TEST_CASE("horizon: a town ten times as large costs little more from the same corner") {
  const auto triangles_seen = [](const Scene& scene, bool hide) {
    VisibleSets sets(scene);
    Horizon horizon(scene);
    std::size_t triangles = 0;
    for (int i = 0; i < 8; ++i) {
      const culling::View view = looking({-4.6, -17.7, 1.7}, 0.2 + 0.785 * i);
      find_visible(scene, view, Structure::bqr, sets);
      if (hide) horizon.hide(scene, {view.eye}, sets);
      triangles += triangles_of(scene, sets.objects()).size();
    }
    return static_cast<double>(triangles);
  };
  CHECK(triangles_seen(town_of_ten(), false) > 8 * triangles_seen(town(), false));
  CHECK(triangles_seen(town_of_ten(), true) < 3 * triangles_seen(town(), true));
}

}  // namespace manzana
