#include "scenegraph/draw/city_layer.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/draw/hand_scene.h"

namespace manzana::draw {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> triangles(std::span<const std::uint32_t> indices, std::size_t begin, std::size_t end) {
  std::vector<Triangle> found;
  for (std::size_t i = begin; i < end; i += 3) found.push_back({indices[i], indices[i + 1], indices[i + 2]});
  std::sort(found.begin(), found.end());
  return found;
}

MeshLayer mixed_layer() {
  HandBlock block;
  for (int i = 0; i < 9; ++i) {
    block.buildings.push_back(make_box({20.0F * static_cast<float>(i), 0, 0}, {10, 10, 10}, 0x808080,
                                       i % 3 == 2 ? Material::concrete : Material::wall));
  }
  return make_scene({block}).buildings;
}

}  // namespace

TEST_CASE("sorting by paint keeps every triangle of every object, each once") {
  MeshLayer layer = mixed_layer();
  const CityMesh mesh{layer.mesh.vertices.own(), layer.mesh.indices.own()};
  const PaintedIndices sorted = sort_by_paint(mesh, layer.index_first);
  REQUIRE(sorted.indices.size() == mesh.indices.size());
  for (std::size_t i = 0; i + 1 < layer.index_first.size(); ++i) {
    std::vector<Triangle> of_object;
    for (const auto& first : sorted.first) {
      const auto part = triangles(sorted.indices, first[i], first[i + 1]);
      of_object.insert(of_object.end(), part.begin(), part.end());
    }
    std::sort(of_object.begin(), of_object.end());
    CHECK(of_object == triangles(mesh.indices, layer.index_first[i], layer.index_first[i + 1]));
  }
}

TEST_CASE("a street's vertices know its lanes, also across a middle line") {
  HandMesh street;
  add_quad(street, {0, 0, 0}, {10, 0, 0}, {10, 6, 0}, {0, 6, 0}, 0, Material::asphalt, {10, 2});
  HandMesh wide;
  add_quad(wide, {0, 0, 0}, {10, 0, 0}, {10, 6, 0}, {0, 6, 0}, 0, Material::asphalt, {10, 2});
  for (const CityVertex& v : std::vector<CityVertex>(wide.vertices)) {
    if (v.uv.y == 2) wide.vertices.push_back({v.position + Vec3(0, 6, 0), v.normal, v.colour, {v.uv.x, 4}, 0});
  }
  wide.indices.insert(wide.indices.end(), {3, 2, 4, 3, 4, 5});
  CityMesh mesh{street.vertices, street.indices};
  CHECK(count_lanes(mesh) == std::vector<std::uint8_t>(4, 2));
  mesh = {wide.vertices, wide.indices};
  CHECK(count_lanes(mesh) == std::vector<std::uint8_t>(6, 4));
  const HandMesh grass = make_level({0, 0, 0}, {10, 10}, 0, Material::grass);
  CHECK(count_lanes({grass.vertices, grass.indices}) == std::vector<std::uint8_t>(4, 0));
}

}  // namespace manzana::draw
