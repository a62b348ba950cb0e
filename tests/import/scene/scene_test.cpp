// Whole scenes, from features to what is visible: the promises that hold between the parts.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "culling/baselines/exact.h"
#include "scenegraph/import/import.h"
#include "scenegraph/visible.h"
#include "tests/support/data.h"
#include "tests/support/random.h"

using namespace manzana;

namespace {

const Imported& town() {
  static const Imported city = import_city("builtin:town", {}, {});
  return city;
}

// Tells once more what a layer promises: columns of the right length, runs of indices in order.
void check_layer(const Scene& scene, const MeshLayer& layer) {
  REQUIRE(layer.table.row_first.size() == scene.tree.objects() + std::size_t{1});
  REQUIRE(layer.table.row_first.back() == layer.table.size());
  REQUIRE(layer.index_first.size() == layer.table.size() + std::size_t{1});
  REQUIRE(layer.index_first.back() == layer.mesh.indices.size());
  CHECK(std::is_sorted(layer.index_first.begin(), layer.index_first.end()));
  CHECK(*std::max_element(layer.mesh.indices.begin(), layer.mesh.indices.end()) < layer.mesh.vertices.size());
}

using Point = glm::vec<3, long double>;

bool holds(const culling::SphereD& s, const Point& p) {
  return glm::length(p - Point(s.center)) <= static_cast<long double>(s.radius);
}
template <class AnyBox>
bool holds(const AnyBox& b, const Point& p) {
  return glm::all(glm::lessThanEqual(Point(b.min), p)) && glm::all(glm::lessThanEqual(p, Point(b.max)));
}

// Both volumes of every lane above the block hold the point, relative to the tree's origin.
int violations(const culling::BqrTree& tree, std::uint32_t block, const Point& p) {
  int wrong = 0;
  for (const culling::BqrNode& node : tree.nodes)
    for (std::uint32_t i = 0; i < culling::kLanes; ++i)
      if ((node.lanes >> i & 1) != 0 && block >= node.first_block[i] && block < node.last_block[i])
        wrong += holds(lane_sphere(node, i), p) && holds(lane_box(node, i), p) ? 0 : 1;
  return wrong;
}

int violations(const Scene& scene, const MeshLayer& layer) {
  int wrong = 0;
  for (std::uint32_t block = 0; block < scene.blocks.size(); ++block) {
    const culling::ObjectRun rows = layer.table.rows(scene.tree.block_objects[block]);
    for (std::uint32_t row = rows.first; row < rows.last; ++row)
      for (std::uint32_t k = layer.index_first[row]; k < layer.index_first[row + 1]; ++k) {
        const CityVertex& v = layer.mesh.vertices[layer.mesh.indices[k]];
        wrong += v.block == block ? 0 : 1;
        const BlockFrame& frame = scene.blocks[block];
        const Point local = Point(frame.origin) + glm::mat<3, 3, long double>(frame.axes) * Point(v.position);
        const Point p = local - Point(scene.tree.origin);
        wrong += (holds(layer.table.boxes[row], p) ? 0 : 1) + violations(scene.tree, block, p);
      }
  }
  return wrong;
}

culling::View random_view(const Scene& scene, support::Random& random) {
  const Vec3d size = scene.bounds.max - scene.bounds.min;
  const double a = random.within(0, 6.2832);
  const Vec3d eye =
      scene.bounds.min + size * Vec3d(random.within(-0.1, 1.1), random.within(-0.1, 1.1), random.within(0, 2));
  return culling::look(eye, {std::cos(a), std::sin(a), random.within(-1, 0.3)}, {0, 0, 1}, random.within(0.2, 1.5),
                       16.0 / 9.0);
}

// Rows of a layer, no run empty or before the one that it follows.
std::set<std::uint32_t> members(const LayerTable& table, std::span<const culling::ObjectRun> objects) {
  std::set<std::uint32_t> ids;
  std::uint32_t last = 0;
  for (const culling::ObjectRun& run : objects) {
    CHECK((run.first >= last && run.first < run.last));
    last = run.last;
    const auto rows = table.rows(run);
    for (std::uint32_t i = rows.first; i < rows.last; ++i) CHECK(ids.insert(i).second);
  }
  return ids;
}

culling::BoxD box_in_scene(const Scene& scene, const LayerTable& table, std::uint32_t i) {
  const culling::Box b = table.boxes[i];
  return {scene.tree.origin + Vec3d(b.min), scene.tree.origin + Vec3d(b.max)};
}

struct Tally {
  std::size_t accepted = 0, exact = 0, missed = 0;
  void add(const Scene& scene, const LayerTable& table, std::span<const culling::ObjectRun> objects,
           const culling::ExactView& view) {
    const std::set<std::uint32_t> seen = members(table, objects);
    accepted += seen.size();
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      const bool truly = exactly_overlaps(view, box_in_scene(scene, table, i));
      exact += truly ? 1 : 0;
      missed += truly && !seen.contains(i) ? 1 : 0;
    }
  }
};

}  // namespace

TEST_CASE("scene: the built-in town is a town, and the same for a seed") {
  const Imported& city = town();
  CHECK(city.report.blocks >= 150);
  CHECK(city.scene.buildings.table.size() >= 3000);
  CHECK(city.scene.trees.table.size() >= 5000);
  CHECK(city.scene.traffic.cars() >= 2000);
  CHECK(city.issues.empty());
  CHECK(city.report.objects ==
        city.scene.buildings.table.size() + city.scene.surfaces.table.size() + city.scene.trees.table.size());
  const Imported again = import_city("builtin:town", {}, {});
  CHECK(again.scene.buildings.mesh.indices == city.scene.buildings.mesh.indices);
  CHECK(std::equal(again.scene.trees.instances.begin(), again.scene.trees.instances.end(),
                   city.scene.trees.instances.begin(), [](const TreeInstance& a, const TreeInstance& b) {
                     return a.position == b.position && a.height_m == b.height_m;
                   }));
  CHECK(again.scene.traffic.offsets == city.scene.traffic.offsets);
  const Imported other = import_city("builtin:town", {.seed = 2}, {});
  CHECK(other.scene.buildings.mesh.vertices.size() != city.scene.buildings.mesh.vertices.size());
#ifdef NDEBUG
  CHECK(city.report.seconds < 3);
#endif
}

TEST_CASE("scene: every species stands in the built-in town, each tree the same on every run") {
  const std::vector<TreeInstance>& trees = town().scene.trees.instances;
  std::map<PlantSpecies, std::size_t> count;
  for (const TreeInstance& tree : trees) ++count[static_cast<PlantSpecies>(tree.plant)];
  for (std::size_t i = 0; i < kPlantSpecies; ++i) {
    CAPTURE(i);
    CHECK(count[static_cast<PlantSpecies>(i)] >= 5);
  }
  for (const auto& [species, n] : count) CHECK(2 * n < trees.size());  // none is most of them
  const Imported again = import_city("builtin:town", {}, {});
  CHECK(std::ranges::equal(trees, again.scene.trees.instances, {}, &TreeInstance::plant, &TreeInstance::plant));
}

TEST_CASE("scene: every vertex lies in its object's box, its block's leaf and all ancestors") {
  const Scene& scene = town().scene;
  check_layer(scene, scene.buildings);
  check_layer(scene, scene.surfaces);
  CHECK(violations(scene, scene.buildings) == 0);
  CHECK(violations(scene, scene.surfaces) == 0);
}

TEST_CASE("scene: nothing that is truly in view is left out, and hardly anything else is taken") {
  const Scene& scene = town().scene;
  support::Random random(31);
  VisibleSets sets(scene);
  Tally tally;
  for (int k = 0; k < 60; ++k) {
    const culling::View view = random_view(scene, random);
    find_visible(scene, view, Structure::bqr, sets);
    const culling::ExactView exact = make_exact(view);
    tally.add(scene, scene.buildings.table, sets.objects(), exact);
    tally.add(scene, scene.surfaces.table, sets.objects(), exact);
    tally.add(scene, scene.trees.table, sets.objects(), exact);
  }
  CHECK(tally.missed == 0);
  REQUIRE(tally.exact > 10000);
  CHECK(static_cast<double>(tally.accepted) <= 1.02 * static_cast<double>(tally.exact));
}

TEST_CASE("scene: without a structure everything is taken, once") {
  const Scene& scene = town().scene;
  VisibleSets sets(scene);
  find_visible(scene, culling::look({0, 0, 1e6}, {0, 0, 1}, {0, 1, 0}, 1, 1), Structure::none, sets);  // looks away
  find_cars(scene, 0, sets);
  CHECK(members(scene.buildings.table, sets.objects()).size() == scene.buildings.table.size());
  CHECK(members(scene.trees.table, sets.objects()).size() == scene.trees.table.size());
  CHECK(sets.cars.size() == scene.traffic.cars());
  find_visible(scene, culling::look({0, 0, 1e6}, {0, 0, 1}, {0, 1, 0}, 1, 1), Structure::bqr, sets);
  find_cars(scene, 0, sets);
  CHECK((sets.objects().empty() && sets.cars.empty()));
}

TEST_CASE("scene: cars found by block are those that each car's own clock gives, at any time") {
  const Scene& scene = town().scene;
  support::Random random(32);
  VisibleSets sets(scene);
  for (int k = 0; k < 40; ++k) {
    const culling::View view = random_view(scene, random);
    const std::uint64_t tick = k == 0 ? 0 : random.bits() >> random.below(60);
    find_visible(scene, view, Structure::bqr, sets);
    find_cars(scene, tick, sets);
    std::set<std::uint32_t> lazy;
    for (const CarState& car : sets.cars) CHECK(lazy.insert(car.car).second);
    const culling::ExactView exact = make_exact(view);
    for (std::uint32_t car = 0; car < scene.traffic.cars(); ++car) {
      const CarState state = car_at(scene.traffic, car, tick);
      if (exactly_overlaps(exact, {state.position, state.position})) CHECK(lazy.contains(car));
    }
  }
}

TEST_CASE("scene: the same town at the pole, on the antimeridian and at the equator has the same counts and shapes") {
  const Scene& home = town().scene;
  for (const GeoPoint anchor :
       {GeoPoint{89.9, 25, 0}, GeoPoint{-16.8, 180, 0}, GeoPoint{0, -179.9999, 0}, GeoPoint{-90, 0, 0}}) {
    CityFeatures features = make_town(1);
    features.frame = LocalFrame(anchor);
    const Imported moved = build_scene(std::move(features), {}, {});
    const Scene& scene = moved.scene;
    CHECK(scene.blocks.size() == home.blocks.size());
    CHECK(scene.buildings.table.size() == home.buildings.table.size());
    CHECK(scene.trees.table.size() == home.trees.table.size());
    CHECK(scene.surfaces.mesh.indices.size() == home.surfaces.mesh.indices.size());
    CHECK(scene.traffic.cars() == home.traffic.cars());
    REQUIRE(scene.buildings.mesh.vertices.size() == home.buildings.mesh.vertices.size());
    float farthest = 0;
    for (std::size_t i = 0; i < scene.buildings.mesh.vertices.size(); ++i)
      farthest = std::max(
          farthest, glm::length(scene.buildings.mesh.vertices[i].position - home.buildings.mesh.vertices[i].position));
    CHECK(farthest < 0.01F);  // the Earth is rounder at the equator than at the pole: millimetres in a block
  }
}

TEST_CASE("scene: each block stands upright on its own ground") {
  const auto file = data_file("osm/liechtenstein-2015.osm.pbf");
  if (!file) return;
  const Scene scene = import_city(file->string(), {.cars = 100}, {}).scene;
  double tilt = 0;
  for (const BlockFrame& block : scene.blocks) {
    const GeoPoint foot = scene.frame.to_geo(block.origin), above = scene.frame.to_geo(block.to_local({0, 0, 100}));
    CHECK(std::abs(foot.height_m) < 1e-6);
    CHECK(above.height_m == Approx(100).margin(1e-6));
    CHECK(std::abs(above.lat_deg - foot.lat_deg) < 1e-9);
    tilt = std::max(tilt, std::acos(std::min(1.0, block.axes[2].z)));
  }
  CHECK(tilt > glm::radians(0.05));  // the country is large enough for it to matter
}

TEST_CASE("scene: nothing at all is a scene too") {
  const Imported empty = build_scene(CityFeatures(), {}, {});
  VisibleSets sets(empty.scene);
  find_visible(empty.scene, culling::look({0, 0, 2}, {0, 1, 0}, {0, 0, 1}, 1, 1), Structure::bqr, sets);
  find_cars(empty.scene, 7, sets);
  CHECK(empty.report.blocks == 0);
  CHECK((sets.blocks().empty() && sets.objects().empty() && sets.cars.empty()));
  CHECK_THROWS_WITH(import_city("builtin:city", {}, {}), Catch::Contains("builtin:town"));
}

TEST_CASE("scene: a town ten times as large has the town in its middle") {
  const CityFeatures town = make_town(1), large = make_town(1, 10);
  CHECK(large.buildings.size() > 8 * town.buildings.size());
  CHECK(large.buildings.size() < 12 * town.buildings.size());
  const std::size_t first = 3;  // after the church
  for (std::size_t i = first; i < town.buildings.size(); i += 97)
    CHECK(large.buildings[i].footprint.outer == town.buildings[i].footprint.outer);
  for (const char* name : {"builtin:town:", "builtin:town:0", "builtin:town:1e9", "builtin:town:ten", "builtin:towns"})
    CHECK_THROWS_WITH(read_city(name, {}, {}), Catch::Contains("builtin:town:10"));
}

TEST_CASE("scene: the village shows all that is read") {
  const Imported village = import_city(MANZANA_VILLAGE, {}, {});
  CHECK(village.issues.empty());
  CHECK(village.scene.buildings.table.size() > 60);
  CHECK(village.scene.trees.table.size() > 100);
  CHECK(village.scene.traffic.cars() > 0);
  CHECK(village.report.blocks > 5);
}

TEST_CASE("what is asked for by class is what is found without and is of that class") {
  const Scene& scene = town().scene;
  support::Random random(77);
  VisibleSets all(scene), some(scene);
  std::size_t asked = 0;
  for (int i = 0; i < 60; ++i) {
    const culling::View view = random_view(scene, random);
    some.classes = i % 3 == 0 ? classes_named("building20 conifer") : static_cast<culling::ClassMask>(random.bits());
    find_visible(scene, view, Structure::bqr, all);
    find_visible(scene, view, Structure::bqr, some);
    std::vector<bool> wanted(scene.tree.objects(), false), found(wanted);
    for (const culling::ObjectRun& run : all.objects())
      for (std::uint32_t o = run.first; o < run.last; ++o) wanted[o] = (scene.tree.classes[o] & some.classes) != 0;
    for (const culling::ObjectRun& run : some.objects())
      for (std::uint32_t o = run.first; o < run.last; ++o) found[o] = true;
    REQUIRE(found == wanted);
    asked += static_cast<std::size_t>(std::count(found.begin(), found.end(), true));
    find_cars(scene, 0, all);
    find_cars(scene, 0, some);
    REQUIRE(some.cars.size() == ((some.classes & kCar) != 0 ? all.cars.size() : 0));
  }
  CHECK(asked > 1000);
}

TEST_CASE("classes are what the objects are") {
  const Scene& scene = town().scene;
  std::map<int, int> of;
  for (std::uint32_t o = 0; o < scene.tree.objects(); ++o) {
    const int kind = scene.tree.classes[o];
    ++of[kind];
    const std::uint32_t building = scene.buildings.table.row_first[o], tree = scene.trees.table.row_first[o];
    if (building < scene.buildings.table.row_first[o + 1]) {
      const culling::BoxD box = box_in_scene(scene, scene.buildings.table, building);
      const double height = box.max.z - box.min.z;  // in L: some decimetres more than upright
      REQUIRE((kind & kBuildings) != 0);
      if (height < 9) CHECK(kind == kBuilding);
      if (height > 21 && height < 39) CHECK(kind == kBuildingOver20);
    } else if (tree < scene.trees.table.row_first[o + 1]) {
      const TreeInstance& t = scene.trees.instances[tree];
      REQUIRE(kind == tree_class(kind_of(static_cast<PlantSpecies>(t.plant)), static_cast<double>(t.height_m)));
    } else {
      REQUIRE(kind == kSurface);
    }
  }
  CHECK(of.size() >= 7);
  CHECK(classes_named("building") == kBuildings);
  CHECK(classes_named("tree15,conifer street") == (kBroadleafOver15 | kConiferOver15 | kConifer | kSurface));
  CHECK(classes_named("") == 0);
  CHECK_THROWS_WITH(classes_named("tree,cow"), "no class is called 'cow'");
}
