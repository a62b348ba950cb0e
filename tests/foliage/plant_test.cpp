#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

Plant leafy_plant() {
  Plant plant = spiral_plant(5);
  for (std::int32_t i = 0; i < 3; ++i) {
    const auto first = static_cast<std::uint32_t>(plant.mesh.leaves.triangles());
    MeshVertex v{{0, 0, 1}, {0, 0, 1}, {0, 0}, 1};
    add_quad(plant.mesh.leaves, {v, v, v, v});
    plant.terminals.push_back({{first, first + 2}, i - 1, Organ::leaf});
  }
  return plant;
}

struct Damage {
  const char* says;
  std::function<void(Plant&)> make;
};

}  // namespace

TEST_CASE("a sound plant passes its check") {
  CHECK_NOTHROW(check(Plant{}));
  CHECK_NOTHROW(check(leafy_plant()));
}

TEST_CASE("the check names the row of whatever breaks a rule") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const std::vector<Damage> cases{
      {"branch 2 has a parent", [](Plant& p) { p.branches[2].parent = 2; }},
      {"branch 0 has a parent", [](Plant& p) { p.branches[0].parent = -2; }},
      {"branch 3 has a centre line", [](Plant& p) { p.branches[3].line.last = p.branches[3].line.first + 1; }},
      {"branch 5 has a centre line", [](Plant& p) { ++p.branches[5].line.last; }},
      {"branch 3 shares its centre line", [](Plant& p) { p.branches[3].line = p.branches[2].line; }},
      {"branch 1 does not begin", [](Plant& p) { ++p.branches[1].triangles.first; }},
      {"branch 5 has triangles", [](Plant& p) { ++p.branches[5].triangles.last; }},
      {"belongs to no branch", [](Plant& p) { p.branches.pop_back(); }},
      {"terminal 1 has no triangle", [](Plant& p) { p.terminals[1].triangles.last = 2; }},
      {"terminal 2 is on a branch", [](Plant& p) { p.terminals[2].branch = 6; }},
      {"terminal 0 is on a branch", [](Plant& p) { p.terminals[0].branch = -2; }},
      {"terminal 2 does not begin",
       [](Plant& p) {
         p.terminals[2].triangles = {5, 6};
       }},
      {"triangle 4 belongs to no terminal", [](Plant& p) { p.terminals.pop_back(); }},
      {"bark triangle 7 has a vertex", [](Plant& p) { p.mesh.bark.indices[22] = ~0U; }},
      {"leaf triangles have indices", [](Plant& p) { p.mesh.leaves.indices.pop_back(); }},
      {"bark vertex 9 is not finite", [=](Plant& p) { p.mesh.bark.vertices[9].position.y = kNan; }},
      {"leaf vertex 1 is not finite", [=](Plant& p) { p.mesh.leaves.vertices[1].uv.x = -kInf; }},
      {"leaf vertex 2 is not finite", [](Plant& p) { p.mesh.leaves.vertices[2].position.x = 2e6F; }},
      {"centre point 4 is not finite", [=](Plant& p) { p.centre_lines[4].radius = kInf; }},
      {"centre point 4 is not finite", [](Plant& p) { p.centre_lines[4].radius = -0.1F; }},
      {"the leaf image",
       [](Plant& p) {
         p.leaf_image = {3, std::vector<std::uint8_t>(36)};
       }},
      {"the bark image",
       [](Plant& p) {
         p.bark_image = {4, std::vector<std::uint8_t>(63)};
       }},
  };
  for (const Damage& damage : cases) {
    INFO(damage.says);
    Plant plant = leafy_plant();
    damage.make(plant);
    CHECK_THROWS_WITH(check(plant), Catch::Contains(damage.says));
    CHECK_THROWS_AS(check(plant), std::invalid_argument);
  }
}

}  // namespace manzana::foliage
