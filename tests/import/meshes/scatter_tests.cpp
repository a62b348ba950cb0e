#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>

#include "scenegraph/import/plan_geometry.h"
#include "scenegraph/import/plan_index.h"
#include "tests/import/meshes/mesh_checks.h"

using namespace checks;

namespace {

AreaFeature wood(Polygon shape, double per_ha) {
  AreaFeature a;
  a.shape = std::move(shape);
  a.kind = Material::wood;
  a.trees_per_ha = per_ha;
  return a;
}

double least_distance(const std::vector<TreeFeature>& trees) {
  double least = 1e9;
  for (std::size_t i = 0; i < trees.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, glm::distance(trees[i].position, trees[j].position));
  return least;
}

bool inside(const std::vector<Vec2d>& ring, const Vec2d& p) {  // winding by angles: unlike the scatter's own test
  double angle = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
    angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return std::abs(angle) > 3;
}

bool same(const std::vector<TreeFeature>& a, const std::vector<TreeFeature>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& s, const auto& t) {
           return s.position == t.position && s.height == t.height && s.crown_radius == t.crown_radius &&
                  s.kind == t.kind;
         });
}

}  // namespace

TEST_CASE("scattered trees have their density and keep their distance") {
  for (const double per_ha : {30.0, 150.0, 400.0, 1200.0})
    for (const Vec2d at : {Vec2d{0, 0}, Vec2d{1e5, -1e5}}) {
      INFO(per_ha << " trees per ha");
      CityFeatures city;
      const double side = std::sqrt(3000 * 1e4 / per_ha);
      city.areas.push_back(wood(rectangle(at.x, at.y, side, side), per_ha));
      const auto trees = scatter_trees(city, 1);
      CHECK(double(trees.size()) == Approx(3000).epsilon(0.10));
      CHECK(least_distance(trees) >= 0.7 / std::sqrt(per_ha / 1e4) * (1 - 1e-9));
      for (const TreeFeature& t : trees) {
        CHECK(t.position.x >= at.x);
        CHECK(t.position.x <= at.x + side);
        CHECK(t.height > 1);
        CHECK(t.height < 30);
        CHECK(t.crown_radius > 0.2);
      }
    }
}

TEST_CASE("trees spread evenly: no quarter of a wood is thin, no row is straight") {
  CityFeatures city;
  city.areas.push_back(wood(rectangle(0, 0, 400, 400), 200));
  int quarter[16] = {};
  for (const TreeFeature& t : scatter_trees(city, 3)) ++quarter[int(t.position.x / 100) + 4 * int(t.position.y / 100)];
  for (const int n : quarter) CHECK(n == Approx(200).epsilon(0.15));
}

TEST_CASE("the same seed gives the same trees, in whatever order the areas come, another seed gives others") {
  CityFeatures city;
  Random random{8};
  for (int i = 0; i < 12; ++i)
    city.areas.push_back(wood({star(random, {i % 4 * 60.0, i / 4 * 60.0}, 11, 20, 50), {}}, random.between(50, 500)));
  for (auto& a : city.areas) a.mixed = true;
  const auto trees = scatter_trees(city, 7);
  CHECK(same(trees, scatter_trees(city, 7)));
  CHECK(!same(trees, scatter_trees(city, 8)));
  std::reverse(city.areas.begin(), city.areas.end());
  CHECK(same(trees, scatter_trees(city, 7)));
  const auto broad = std::count_if(trees.begin(), trees.end(), [](auto& t) { return t.kind == PlantKind::broadleaf; });
  CHECK(double(broad) / double(trees.size()) == Approx(0.5).margin(0.1));
}

TEST_CASE("areas that overlap are not planted twice") {
  CityFeatures city;
  for (int i = 0; i < 5; ++i) city.areas.push_back(wood(rectangle(0, 0, 200, 200), 300));
  const auto trees = scatter_trees(city, 1);
  CHECK(trees.size() < 1320);
  CHECK(least_distance(trees) >= 0.7 / std::sqrt(0.03) * (1 - 1e-9));
}

TEST_CASE("no tree on a street, at a wall, in a building, in water, in a hole or on a mapped tree") {
  const std::uint64_t seed = 12;
  INFO("seed " << seed);
  Random random{seed};
  CityFeatures city;
  Polygon ground{star(random, {0, 0}, 40, 150, 300), {star(random, {60, 60}, 9, 15, 40)}};
  city.areas.push_back(wood(ground, 600));
  for (int i = 0; i < 20; ++i) {
    const Vec2d at{random.between(-250, 250), random.between(-250, 250)};
    BuildingFeature b;
    b.footprint.outer = star(random, at, random.whole(3, 9), 5, 20);
    city.buildings.push_back(b);
  }
  AreaFeature lake = wood({star(random, {-80, 30}, 60, 20, 60), {}}, 0);
  lake.kind = Material::water;
  city.areas.push_back(lake);
  for (int i = 0; i < 8; ++i) {
    StreetFeature s;
    s.width = random.between(3, 14);
    for (int k = 0; k < 5; ++k) s.line.emplace_back(random.between(-300, 300), random.between(-300, 300));
    s.tunnel = i == 7;
    city.streets.push_back(s);
  }
  for (int i = 0; i < 100; ++i) {
    TreeFeature t;
    t.position = {random.between(-200, 200), random.between(-200, 200)};
    city.trees.push_back(t);
  }
  const auto trees = scatter_trees(city, 5);
  REQUIRE(trees.size() > 1000);
  bool over_tunnel = false;
  for (const TreeFeature& t : trees) {
    const Vec2d p = t.position;
    CHECK(inside(ground.outer, p));
    CHECK(!inside(ground.holes[0], p));
    CHECK(!inside(lake.shape.outer, p));
    for (const auto& b : city.buildings) CHECK(!inside(b.footprint.outer, p));
    for (const auto& m : city.trees) CHECK(glm::distance(m.position, p) >= 3);
    for (const auto& s : city.streets)
      for (std::size_t k = 1; k < s.line.size(); ++k) {
        const Vec2d d = s.line[k] - s.line[k - 1];
        const double along = std::clamp(glm::dot(p - s.line[k - 1], d) / glm::dot(d, d), 0.0, 1.0);
        const double gap = glm::distance(p, s.line[k - 1] + along * d) - s.width / 2;
        if (s.tunnel) {
          over_tunnel = over_tunnel || gap < 0;
        } else {
          CHECK(gap >= 1.5 - 1e-9);
        }
      }
  }
  CHECK(over_tunnel);
}

TEST_CASE("scattering always ends, and refuses nonsense") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  CityFeatures city;
  city.areas = {wood(rectangle(0, 0, 1, 1), 1e12),
                wood(rectangle(0, 0, 1e6, 1e6), 1e5),
                wood({}, 100),
                wood({{{0, 0}, {nan, 1}, {2, 2}}, {}}, 100),
                wood({{{0, 0}, {inf, 1}, {2, 2}}, {}}, 10),
                wood(rectangle(0, 0, 10, 10), nan),
                wood(rectangle(0, 0, 10, 10), -5),
                wood(rectangle(0, 0, 10, 10), 1e-300),
                wood(rectangle(-9e6, 0, 1.8e7, 1e-3), 500),
                wood(rectangle(0, -9e6, 1e-3, 1.8e7), 500)};
  StreetFeature street;
  street.line = {{-1e300, 0}, {nan, 0}, {1e7, 1e7}};
  street.width = inf;
  city.streets.push_back(street);
  TreeFeature tree;
  tree.position = {nan, inf};
  city.trees.push_back(tree);
  const auto trees = scatter_trees(city, 1);
  CHECK(trees.size() > 100000);
  CHECK(trees.size() < 1300000);
  for (std::size_t i = 0; i < trees.size(); i += 1000) CHECK(std::isfinite(trees[i].position.x));
}

TEST_CASE("polygon rows agree with angles") {
  const std::uint64_t seed = 61;
  INFO("seed " << seed);
  Random random{seed};
  for (int i = 0; i < 50; ++i) {
    const Polygon p{star(random, {5, -3}, random.whole(3, 80), 2, 30), {}};
    const plan::PolygonRows rows(p), coarse(p, 100), fine(p, 0.1);
    for (int k = 0; k < 200; ++k) {
      const Vec2d q{random.between(-30, 40), random.between(-40, 30)};
      CHECK(rows.contains(q) == inside(p.outer, q));
      CHECK(coarse.contains(q) == inside(p.outer, q));
      CHECK(fine.contains(q) == inside(p.outer, q));
    }
  }
}

TEST_CASE("a forest of 60 000 trees grows quickly", "[timing]") {
  Random random{2};
  CityFeatures city;
  city.areas.push_back(wood({star(random, {0, 0}, 2000, 850, 1000), {}}, 60000 / 270.0));
  const auto start = std::chrono::steady_clock::now();
  const auto trees = scatter_trees(city, 1);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  WARN(trees.size() << " trees in " << seconds << " s");
  CHECK(trees.size() > 50000);
  CHECK(seconds < 10);  // a guard against the quadratic, not a measurement
}
