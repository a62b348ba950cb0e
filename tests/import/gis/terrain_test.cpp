// Relief: what a terrain says between its corners, and what stands and lies on it.
#include "scenegraph/import/terrain.h"

#include <map>

#include "scenegraph/import/scene_plants.h"
#include "tests/import/gis/hills.h"
#include "tests/support/data.h"
#include "tests/support/random.h"

namespace {

using namespace manzana;

double plan_area(const CityMesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return Vec2d(Vec2(mesh.vertices[mesh.indices[i + k]].position)); };
    const Vec2d a = at(1) - at(0), b = at(2) - at(0);
    area += (a.x * b.y - a.y * b.x) / 2;
  }
  return area;
}

/// A triangle 0.5 m above ground.
CityMesh triangle(const Vec2& a, const Vec2& b, const Vec2& c) {
  CityMesh mesh;
  for (const Vec2& p : {a, b, c}) mesh.vertices.push_back({Vec3(p, 0.5F), pack_normal({0, 0, 1}), 7, p, 0});
  mesh.indices = {0, 1, 2};
  return mesh;
}

/// How far the mesh is from 0.5 m above the terrain, at corners, middles of edges and middles of triangles.
double worst(const CityMesh& mesh, const Vec2d& center, const Terrain& terrain) {
  double most = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return Vec3d(mesh.vertices[mesh.indices[i + k % 3]].position); };
    for (const Vec3d& p :
         {at(0), (at(0) + at(1)) / 2.0, (at(1) + at(2)) / 2.0, (at(2) + at(0)) / 2.0, (at(0) + at(1) + at(2)) / 3.0})
      most = std::max(most, std::abs(p.z - 0.5 - terrain.at(center + Vec2d(p))));
  }
  return most;
}

struct Built {
  Terrain terrain = hills();
  CityFeatures features = read_city(MANZANA_VILLAGE, {}, {});
  Imported city = build_scene(features, terrain, {}, {});
  /// Height over the level ground, and the plan position.
  std::pair<double, Vec2d> over_level(std::uint32_t block, const Vec3d& p) const {
    const Vec3d local = city.scene.blocks[block].to_local(p);
    return {local.z - city.scene.frame.ground_z(Vec2d(local)), Vec2d(local)};
  }
};

/// Of the middles of their triangles, above the terrain: the lowest, and the share of those within 0.3 m. Without the
/// concrete of bridges, whose walls go down into the ground.
std::pair<double, double> heights_of_surfaces(const Built& built) {
  const StoredMesh& mesh = built.city.scene.surfaces.mesh;
  double lowest = 1e9, near = 0, all = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const CityVertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                     &c = mesh.vertices[mesh.indices[i + 2]];
    if (static_cast<Material>(a.colour >> 24) == Material::concrete) continue;
    all += 1;
    const auto [height, plan] =
        built.over_level(a.block, (Vec3d(a.position) + Vec3d(b.position) + Vec3d(c.position)) / 3.0);
    lowest = std::min(lowest, height - built.terrain.at(plan));
    near += height - built.terrain.at(plan) < 0.3 ? 1 : 0;
  }
  return {lowest, near / all};
}

}  // namespace

TEST_CASE("terrain: corners are as given and a plane is a plane and beyond the edge it goes on") {
  Terrain t;
  t.origin = {10, 20};
  t.step = 5;
  t.columns = 4;
  t.rows = 3;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) t.heights.push_back(static_cast<float>(2 * c + 3 * r));
  CHECK(t.at({10, 20}) == 0);
  CHECK(t.at({25, 30}) == 12);
  for (const Vec2d& p : {Vec2d(11, 23), Vec2d(17.5, 21), Vec2d(24.9, 29.9)})
    CHECK(t.at(p) == Approx(2 * (p.x - 10) / 5 + 3 * (p.y - 20) / 5));
  CHECK(t.at({0, 20}) == 0);
  CHECK(t.at({100, 100}) == 12);
  CHECK(t.slope_at({17, 25}).x == Approx(0.4));
  CHECK(t.slope_at({17, 25}).y == Approx(0.6));
  CHECK(Terrain().at({1, 1}) == 0);
}

TEST_CASE("terrain: what is draped lies on every facet and keeps its area in plan") {
  const Terrain terrain = hills();
  const Vec2d center(13, -27);
  for (CityMesh mesh : {triangle({0, 0}, {150, 3}, {20, 130}), triangle({-140, -60}, {130, -61}, {129, 140}),
                        triangle({1, 1}, {3, 1}, {2, 3}), triangle({-23, 7}, {57, 7}, {17, 47})}) {
    const double area = plan_area(mesh);
    drape(mesh, center, terrain);
    CHECK(worst(mesh, center, terrain) < 1e-4);
    CHECK(plan_area(mesh) == Approx(area).epsilon(1e-5));
    for (const CityVertex& v : mesh.vertices) CHECK((v.colour == 7 && v.uv.x == Approx(v.position.x).margin(1e-4)));
  }
}

TEST_CASE("terrain: what lies in one facet is only raised and level ground changes nothing") {
  CityMesh small = triangle({1, 1}, {2, 1}, {2, 1.5F}), same = triangle({0, 0}, {150, 3}, {20, 130});
  drape(small, {-2009.9, -1989.9}, hills());
  CHECK(small.vertices.size() == 3);
  drape(same, {0, 0}, Terrain());
  CHECK(same.vertices.size() == 3);
  CHECK(same.vertices[1].position == Vec3(150, 3, 0.5F));
}

TEST_CASE("terrain: buildings and trees of the village stand on it") {
  const Built built;
  const Scene& scene = built.city.scene;
  REQUIRE(scene.buildings.table.size() > 60);
  for (const TreeInstance& tree : scene.trees.instances) {
    const auto [height, plan] = built.over_level(tree.block, Vec3d(tree.position));
    CHECK(height == Approx(built.terrain.at(plan)).margin(0.01));
  }
  std::size_t standing = 0;
  for (std::uint32_t i = 0; i < scene.buildings.table.size(); ++i) {
    double lowest = 1e9, ground = 1e9;
    for (std::uint32_t k = scene.buildings.index_first[i]; k < scene.buildings.index_first[i + 1]; ++k) {
      const CityVertex& v = scene.buildings.mesh.vertices[scene.buildings.mesh.indices[k]];
      const auto [height, plan] = built.over_level(v.block, Vec3d(v.position));
      lowest = std::min(lowest, height);
      ground = std::min(ground, built.terrain.at(plan));
    }
    CHECK(lowest > ground - 0.05);
    if (lowest < ground + 0.05) ++standing;
  }
  CHECK(standing > scene.buildings.table.size() * 3 / 4);  // the others are parts that begin higher up
}

TEST_CASE("terrain: streets and greens lie on it as they lie on level ground") {
  Built built;
  const auto [lowest, near] = heights_of_surfaces(built);
  built.terrain = Terrain();
  built.city = build_scene(built.features, {}, {});
  const auto [level_lowest, level_near] = heights_of_surfaces(built);
  CHECK(lowest > -0.01);  // where the grass below all lies
  CHECK(level_lowest > 0);
  CHECK(near > 0.6);
  CHECK(level_near > 0.6);
}

TEST_CASE("terrain: cars drive on it") {
  const Built built;
  const Traffic& traffic = built.city.scene.traffic;
  REQUIRE(traffic.points.size() > 100);
  const CityFeatures& features = built.features;
  const Imported level = build_scene(features, {}, {});
  double worst_between = 0;
  for (const HalfStreet& half : traffic.halves)
    for (std::uint32_t i = half.first_point; i + 1 < half.last_point; ++i) {
      const Vec3d a = traffic.points[i].position, b = traffic.points[i + 1].position, middle = (a + b) / 2.0;
      const LocalFrame& frame = built.city.scene.frame;
      const auto above = [&](const Vec3d& p) { return p.z - frame.ground_z(Vec2d(p)) - built.terrain.at(Vec2d(p)); };
      CHECK(above(a) > 0.12);
      worst_between = std::max(worst_between, std::abs(above(middle) - (above(a) + above(b)) / 2));
    }
  CHECK(worst_between < 0.6);  // a line of 8 m over a ridge between two facets
  CHECK(traffic.cars() == level.scene.traffic.cars());
}
