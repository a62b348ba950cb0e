#include "foliage/plant_quads.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

using Triangle = std::array<float, 9>;

/// Turned so that the least corner is first: the winding stays.
Triangle triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto flat = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    return Triangle{p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z};
  };
  return std::min({flat(a, b, c), flat(b, c, a), flat(c, a, b)});
}

std::vector<Triangle> triangles_of(const MeshPart& part) {
  std::vector<Triangle> out;
  const auto at = [&](std::size_t i) { return part.vertices[part.indices[i]].position; };
  for (std::size_t i = 0; i < part.indices.size(); i += 3) out.push_back(triangle(at(i), at(i + 1), at(i + 2)));
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Triangle> triangles_of(const std::vector<PlantQuad>& quads) {
  std::vector<Triangle> out;
  for (const PlantQuad& quad : quads) {
    const auto at = [&](std::size_t i) { return quad.corners[i].position; };
    out.push_back(triangle(at(0), at(1), at(2)));
    if (at(2) != at(3)) out.push_back(triangle(at(0), at(2), at(3)));
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<PlantQuad> quads_of(const MeshPart& part) {
  std::vector<PlantQuad> quads;
  add_quads(part, part.indices, {{1, 2, 3}, 7}, quads);
  return quads;
}

}  // namespace

TEST_CASE("a tube pairs up wholly and keeps its winding") {
  for (const int sides : {3, 4, 6, 8}) {
    Plant plant;
    add_straight_branch(plant, -1, {0, 0, 0}, {1, 1, 3}, 0.2F, 5, sides);
    const auto quads = quads_of(plant.mesh.bark);
    CHECK(triangles_of(quads) == triangles_of(plant.mesh.bark));
    CHECK(quads.size() == (plant.mesh.bark.triangles() + 1) / 2);
  }
}

TEST_CASE("triangles in any order become quads without loss") {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    MeshPart part;
    for (int i = 0; i < 12; ++i)
      part.vertices.push_back({{random.spread(1), random.spread(1), random.spread(1)}, {0, 0, 1}, {0, 0}});
    for (int i = 0; i < 20; ++i) {
      const auto a = static_cast<std::uint32_t>(random.bits() % 12);
      for (const std::uint32_t v : {a, (a + 1 + static_cast<std::uint32_t>(random.bits() % 5)) % 12, (a + 7) % 12})
        part.indices.push_back(v);
    }
    const auto quads = quads_of(part);
    CHECK(triangles_of(quads) == triangles_of(part));
  }
}

TEST_CASE("quads carry anchor and level and packed corners") {
  MeshPart part;
  add_quad(part, {MeshVertex{{0, 0, 0}, {0, 0, 1}, {0, 8}, 0}, MeshVertex{{1, 0, 0}, {0, 0, 1}, {4, 0}, 0.5F},
                  MeshVertex{{1, 1, 0}, {0, 0, 1}, {8, 0}, 1}, MeshVertex{{0, 1, 0}, {0, 0, 1}, {0, 0}, 1}});
  const auto quads = quads_of(part);
  REQUIRE(quads.size() == 1);
  CHECK(quads[0].anchor == Vec3(1, 2, 3));
  for (std::size_t i = 0; i < 4; ++i) CHECK(quads[0].normals[i] == ((511U << 20) | (3U << 30)));
  std::array<std::uint32_t, 4> shades{quads[0].shades[0], quads[0].shades[1], quads[0].shades[2], quads[0].shades[3]};
  std::sort(shades.begin(), shades.end());
  CHECK(shades == std::array<std::uint32_t, 4>{0, 128, 255, 255});
  CHECK(triangles_of(quads) == triangles_of(part));
}

TEST_CASE("triangles that disagree about the front stay apart") {
  MeshPart part;
  for (int i = 0; i < 4; ++i)
    part.vertices.push_back({{static_cast<float>(i % 2), static_cast<float>(i / 2), 0}, {0, 0, 1}, {0, 0}});
  part.indices = {0, 1, 2, 1, 2, 3};  // the edge 1-2 is walked the same way twice
  CHECK(quads_of(part).size() == 2);
  part.indices = {0, 1, 2, 2, 1, 3};
  CHECK(quads_of(part).size() == 1);
}

}  // namespace manzana::foliage
