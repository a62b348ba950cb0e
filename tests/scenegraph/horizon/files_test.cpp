// Horizons of real cities, at the height of people's eyes: what is taken away is hidden, and it is much.
#include <catch2/catch.hpp>
#include <iostream>

#include "scenegraph/import/import.h"
#include "tests/scenegraph/horizon/rays.h"
#include "tests/support/data.h"

namespace manzana {
namespace {

/// Outside the boxes of buildings, 1.7 m above the ground.
std::vector<Vec3d> places(const Scene& scene, std::size_t n, support::Random& random) {
  const LayerTable& table = scene.buildings.table;
  const auto inside = [&](const Vec2d& at, const culling::Box& b) {
    return glm::all(glm::greaterThan(at, Vec2d(b.min))) && glm::all(glm::lessThan(at, Vec2d(b.max)));
  };
  std::vector<Vec3d> eyes;
  while (eyes.size() < n) {  // near a building, so that it is in the city
    const culling::Box& near = table.boxes[random.bits() % table.size()];
    const Vec2d at = Vec2d(near.min) + Vec2d(random.within(-20, 20), random.within(-20, 20));
    if (std::ranges::any_of(table.boxes, [&](const culling::Box& b) { return inside(at, b); })) continue;
    const Vec2d plan = at + Vec2d(scene.tree.origin);
    eyes.emplace_back(plan, scene.frame.ground_z(plan) + 1.7);
  }
  return eyes;
}

}  // namespace

TEST_CASE("horizon: no ray reaches what was taken away in real cities and it is much") {
  struct City {
    const char* name;
    double least;  ///< of the buildings in the frustum
  };
  for (const City& city : {City{"citymodel/delft-bgt.city.json", 0.5}, City{"osm/helsinki-centre.osm.pbf", 0.7}}) {
    const auto file = data_file(city.name);
    if (!file) return;
    const Scene scene = import_city(file->string(), {}, {}).scene;
    support::Random random(5);
    const Taken taken = check_by_rays(scene, places(scene, 24, random), random);
    const double share = static_cast<double>(taken.buildings_gone) / static_cast<double>(taken.buildings);
    INFO(city.name << ": " << share << " of " << taken.buildings);
    CHECK(share > city.least);
    CHECK(taken.rays > 500);
  }
}

TEST_CASE("horizon: how much is taken away in real cities", "[.bench]") {
  for (const char* name : {"citymodel/delft-bgt.city.json", "citymodel/nl-topo3d.city.json",
                           "osm/helsinki-centre.osm.pbf", "osm/nyc-lower-east-side.osm.pbf"}) {
    const auto file = data_file(name);
    if (!file) return;
    const Scene scene = import_city(file->string(), {}, {}).scene;
    support::Random random(5);
    const auto eyes = places(scene, 200, random);
    taken_away(scene, eyes);
    const auto start = std::chrono::steady_clock::now();
    const Taken t = taken_away(scene, eyes);
    const std::chrono::duration<double, std::micro> us = std::chrono::steady_clock::now() - start;
    std::cout << name << ": " << t.buildings_gone << " of " << t.buildings << " buildings, " << t.gone << " of " << t.of
              << " objects; " << us.count() / 200 << " us a view\n";
  }
}

}  // namespace manzana
