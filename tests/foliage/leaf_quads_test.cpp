// Leaf triangles as quads: the same surface, fewer vertices, scaled about the petiole.
#include "foliage/leaf_quads.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "foliage/generate.h"

namespace manzana::foliage {
namespace {

MeshVertex vertex(float x, float y, float z, float u, float v) {
  MeshVertex out;
  out.position = {x, y, z};
  out.normal = {0, 0, 1};
  out.uv = {u, v};
  return out;
}

/// One leaf card, a unit square that stands on its foot at y = 0; as many triangles more as are given.
Plant one_card() {
  Plant plant;
  add_quad(plant.mesh.leaves,
           {vertex(-.5F, 0, 1, 0, 1), vertex(.5F, 0, 1, 1, 1), vertex(.5F, 1, 1, 1, 0), vertex(-.5F, 1, 1, 0, 0)});
  plant.terminals.push_back({{0, 2}, -1, Organ::leaf});
  return plant;
}

using Positions = std::array<std::array<float, 3>, 3>;

Positions sorted_triangle(std::array<Vec3, 3> t) {
  Positions out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = {t[k].x, t[k].y, t[k].z};
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Positions> surface(const MeshPart& part) {
  std::vector<Positions> out;
  for (std::size_t i = 0; i < part.indices.size(); i += 3)
    out.push_back(sorted_triangle({part.vertices[part.indices[i]].position, part.vertices[part.indices[i + 1]].position,
                                   part.vertices[part.indices[i + 2]].position}));
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Positions> surface(const std::vector<PlantQuad>& quads) {
  std::vector<Positions> out;
  for (const PlantQuad& q : quads) {
    const auto& c = q.corners;
    out.push_back(sorted_triangle({c[0].position, c[1].position, c[2].position}));
    if (!is_triangle(q)) out.push_back(sorted_triangle({c[0].position, c[2].position, c[3].position}));
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

TEST_CASE("a card is one quad with its foot as the anchor") {
  const LeafQuads out = leaf_quads(one_card());
  REQUIRE(out.quads.size() == 1);
  CHECK(out.leaves == std::vector<Run>{{0, 1}});
  CHECK_FALSE(is_triangle(out.quads[0]));
  CHECK(out.quads[0].anchor == Vec3(0, 0, 1));
}

TEST_CASE("a card on a branch is anchored where it meets the branch") {
  Plant plant = one_card();
  plant.centre_lines = {{{2, 0, 1}, .1F}, {{.7F, 0.25F, 1}, .1F}};
  plant.branches.push_back({-1, 0, {0, 2}, {}});
  plant.terminals[0].branch = 0;
  const Vec3 anchor = leaf_quads(plant).quads[0].anchor;
  CHECK(anchor.x == Approx(.5));
  CHECK(anchor.y == Approx(.25));
}

TEST_CASE("triangles that differ at their common edge stay triangles") {
  Plant plant = one_card();
  MeshPart& leaves = plant.mesh.leaves;
  leaves.vertices.push_back(leaves.vertices[2]);
  leaves.indices[4] = 4;
  CHECK(leaf_quads(plant).quads.size() == 1);  // two vertices of one place and look are one corner
  leaves.vertices[4].uv = {.5F, .5F};
  const LeafQuads out = leaf_quads(plant);
  REQUIRE(out.quads.size() == 2);
  CHECK(is_triangle(out.quads[0]));
  CHECK(is_triangle(out.quads[1]));
}

TEST_CASE("quads are the surface of the leaves to the bit") {
  Plant plant = one_card();
  CHECK(surface(leaf_quads(plant).quads) == surface(plant.mesh.leaves));
  // A fan of five triangles is two quads and one triangle.
  MeshPart& part = plant.mesh.leaves;
  part = {};
  part.vertices = {vertex(0, 0, 0, .5F, 1),      vertex(-1, .5F, 0, 0, .7F), vertex(-1, 1, .2F, 0, .4F),
                   vertex(0, 2, .3F, .5F, 0),    vertex(1, 1, .2F, 1, .4F),  vertex(1, .5F, 0, 1, .7F),
                   vertex(.5F, .1F, 0, .7F, .9F)};
  for (std::uint32_t i = 1; i < 6; ++i) part.indices.insert(part.indices.end(), {0, i, i + 1});
  plant.terminals[0].triangles = {0, 5};
  const LeafQuads out = leaf_quads(plant);
  CHECK(out.quads.size() == 3);
  CHECK(std::count_if(out.quads.begin(), out.quads.end(), is_triangle) == 1);
  CHECK(surface(out.quads) == surface(part));
}

TEST_CASE("quads of a grown plant are its leaves") {
  SpeciesParams species;
  species.stems[0].branches = 0;
  species.stems[1] = {.down_angle = 60, .rotate = 140, .branches = 20, .length = .4F};
  species.stems[2] = {.down_angle = 45, .rotate = 140, .branches = 10, .length = .4F};
  const Plant plant = grow_plant(species, 5);
  const LeafQuads out = leaf_quads(plant);
  REQUIRE(out.leaves.size() == plant.terminals.size());
  REQUIRE(!out.quads.empty());
  CHECK(2 * out.quads.size() == plant.mesh.leaves.triangles());
  CHECK(surface(out.quads) == surface(plant.mesh.leaves));
}

}  // namespace manzana::foliage
