// Walls as a horizon takes them: what they are of made and of real buildings, and that nothing of them is air.
#include "scenegraph/upright_walls.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "scenegraph/import/import.h"
#include "tests/support/data.h"
#include "tests/support/random.h"

namespace manzana {
namespace {

/// Faces, counter-clockwise from outside, as one open part: they are seen from both sides.
Scene scene_of(const std::vector<std::vector<Vec3d>>& faces) {
  ConstructionFeature work;
  for (const auto& face : faces) {
    for (const Vec3d& p : face) {
      const auto at = std::ranges::find(work.points, p);
      work.corners.push_back(static_cast<std::uint32_t>(at - work.points.begin()));
      if (at == work.points.end()) work.points.push_back(p);
    }
    work.ring_last.push_back(static_cast<std::uint32_t>(work.corners.size()));
    work.faces.push_back({static_cast<std::uint32_t>(work.ring_last.size()), 0x808080, Material::wall});
  }
  work.part_last.push_back(static_cast<std::uint32_t>(work.faces.size()));
  CityFeatures city;
  city.constructions.push_back(work);
  return build_scene(std::move(city), {.cars = 0}, {}).scene;
}

/// Those that are seen from the south, from west to east.
std::vector<UprightWall> southern(const std::vector<std::vector<Vec3d>>& faces) {
  std::vector<UprightWall> walls = upright_walls(scene_of(faces), 0);
  std::erase_if(walls, [](const UprightWall& w) { return w.b.x <= w.a.x; });
  std::ranges::sort(walls, {}, [](const UprightWall& w) { return w.a.x; });
  return walls;
}

double length(const UprightWall& wall) { return static_cast<double>(glm::distance(wall.a, wall.b)); }
double height(const UprightWall& wall) { return static_cast<double>(wall.top - wall.bottom); }

/// Whether it lies in a triangle that is seen from there, two millimetres off at most.
bool is_covered(const Scene& scene, std::uint32_t building, const Vec3d& at, const Vec3d& out) {
  const MeshLayer& layer = scene.buildings;
  constexpr double kOff = 2e-3;
  for (std::uint32_t i = layer.index_first[building]; i < layer.index_first[building + 1]; i += 3) {
    std::array<Vec3d, 3> t;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const CityVertex& v = layer.mesh.vertices[layer.mesh.indices[i + k]];
      t[k] = scene.blocks[v.block].axes * Vec3d(v.position);
    }
    const Vec3d twice = glm::cross(t[1] - t[0], t[2] - t[0]), normal = twice / glm::length(twice);
    if (!(glm::dot(normal, out) > 0.9) || std::abs(glm::dot(at - t[0], normal)) > kOff) continue;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d edge = t[(k + 1) % 3] - t[k];
      inside = inside && glm::dot(glm::cross(edge, at - t[k]), normal) > -kOff * glm::length(edge);
    }
    if (inside) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("upright walls: a wall of any corners is what it covers from side to side") {
  const std::vector<Vec3d> plain{{0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {0, 0, 6}};
  const auto one = southern({plain});
  REQUIRE(one.size() == 1);
  CHECK(length(one[0]) == Approx(10));
  CHECK(height(one[0]) == Approx(6));
  const auto cut =
      southern({{{0, 0, 0}, {4, 0, 0}, {10, 0, 0}, {10, 0, 2}, {10, 0, 6}, {7, 0, 6}, {0, 0, 6}, {0, 0, 3}}});
  REQUIRE(cut.size() == 1);
  CHECK(length(cut[0]) == Approx(10));
  CHECK(height(cut[0]) == Approx(6));
  const auto gable = southern({{{0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {5, 0, 9}, {0, 0, 6}}});
  REQUIRE_FALSE(gable.empty());
  for (const UprightWall& w : gable) CHECK(height(w) == Approx(6));
  CHECK(southern({{{0, 0, 0}, {10, 0, 0}, {10, 0.01, 6}, {0, 0.01, 6}}}).empty());  // it leans
}

TEST_CASE("upright walls: what is beside and above each other joins and a hole stays one") {
  const auto beside =
      southern({{{0, 0, 0}, {4, 0, 0}, {4, 0, 6}, {0, 0, 6}}, {{4, 0, 0}, {10, 0, 0}, {10, 0, 5}, {4, 0, 5}}});
  REQUIRE(beside.size() == 2);
  CHECK(beside[1].joined);
  CHECK(height(beside[1]) == Approx(5));
  const std::vector<std::vector<Vec3d>> round_hole{{{0, 0, 0}, {10, 0, 0}, {10, 0, 2}, {0, 0, 2}},
                                                   {{0, 0, 2}, {3, 0, 2}, {3, 0, 4}, {0, 0, 4}},
                                                   {{7, 0, 2}, {10, 0, 2}, {10, 0, 4}, {7, 0, 4}},
                                                   {{0, 0, 4}, {10, 0, 4}, {10, 0, 6}, {0, 0, 6}}};
  for (const UprightWall& w : southern(round_hole)) {
    const double middle = static_cast<double>(w.a.x + w.b.x) / 2;
    const double x = middle - static_cast<double>(southern(round_hole).front().a.x);
    if (x > 3 && x < 7) CHECK(height(w) <= 2 + 1e-5);
  }
}

TEST_CASE("upright walls: of real buildings no place of a wall is air and most that stands upright is one") {
  for (const char* name : {"citymodel/delft-bgt.city.json", "citymodel/rotterdam-textured/rotterdam_subset.json",
                           "tiny/denhaag-subset.city.json", "tiny/multi-lod.city.json", "tiny/small.city.jsonl"}) {
    const auto file = data_file(name);
    if (!file) return;
    const Scene scene = import_city(file->string(), {}, {}).scene;
    support::Random random(17);
    std::size_t checked = 0;
    for (std::uint32_t row = 0; row < scene.buildings.table.size(); ++row)
      for (const UprightWall& w : upright_walls(scene, row)) {
        const Vec2d along = glm::normalize(Vec2d(w.b - w.a));
        const Vec3d at(glm::mix(Vec2d(w.a), Vec2d(w.b), random.unit()),
                       random.within(static_cast<double>(w.bottom), static_cast<double>(w.top)));
        INFO(name << " building " << row << " at " << at.x << " " << at.y << " " << at.z);
        REQUIRE(is_covered(scene, row, at, {along.y, -along.x, 0}));
        ++checked;
      }
    INFO(name);
    CHECK(checked > scene.buildings.table.size());
  }
}

}  // namespace manzana
