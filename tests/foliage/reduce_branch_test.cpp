#include "foliage/reduce_branch.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "ortho_mask.h"
#include "tiny_plants.h"

namespace manzana::foliage {
namespace {

Vec3 corner(const MeshPart& part, std::size_t i) { return part.vertices[part.indices[i]].position; }

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);  // [Ericson 2005, section 5.1.5]
  if (d1 <= 0 && d2 <= 0) return a;
  const float d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  if (d1 * d4 - d3 * d2 <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const float d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  if (d5 * d2 - d1 * d6 <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const float va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

/// Largest distance of a's surface, at many places, from b's.
float distance(const MeshPart& a, const MeshPart& b) {
  float most = 0;
  for (std::size_t i = 0; i < a.indices.size(); i += 3) {
    for (const Vec3& w : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(.5F, .5F, 0), Vec3(0, .5F, .5F),
                          Vec3(.5F, 0, .5F), Vec3(1 / 3.0F)}) {
      const Vec3 p = corner(a, i) * w.x + corner(a, i + 1) * w.y + corner(a, i + 2) * w.z;
      float least = 1e30F;
      for (std::size_t j = 0; j < b.indices.size(); j += 3)
        least =
            std::min(least, glm::length(p - nearest_on_triangle(p, corner(b, j), corner(b, j + 1), corner(b, j + 2))));
      most = std::max(most, least);
    }
  }
  return most;
}

double hidden(const MeshPart& part) {
  double sum = 0;
  for (const Vec3& direction : spread_directions(40)) {
    OrthoMask mask(direction, {0, 0, 1}, 3, 600);
    for (std::size_t i = 0; i < part.indices.size(); i += 3)
      mask.triangle(corner(part, i), corner(part, i + 1), corner(part, i + 2));
    sum += mask.area_m2() / 40;
  }
  return sum;
}

}  // namespace

TEST_CASE("a reduced branch is as near as it says and hides as much") {
  constexpr float kOfMean = 2;  // see Reduced::error_m
  for (const int sides : {5, 8, 12}) {
    Plant plant;
    add_straight_branch(plant, -1, {0, 0, 0}, {0.2F, 0.4F, 2}, 0.1F, 12, sides);
    const MeshPart whole = branch_part(plant, plant.branches[0]);
    for (const float error : {0.002F, 0.01F, 0.03F}) {
      INFO(sides << " sides, " << error << " m");
      const Reduced reduced = reduced_branch(whole, plant.centre_lines, error);
      CHECK(reduced.part.triangles() < whole.triangles());
      CHECK(distance(whole, reduced.part) <= kOfMean * reduced.error_m);
      CHECK(distance(reduced.part, whole) <= kOfMean * reduced.error_m);
      CHECK(hidden(reduced.part) == Approx(hidden(whole)).epsilon(0.02));
    }
  }
}

TEST_CASE("the part of a branch has its triangles and no other vertices") {
  const Plant plant = spiral_plant(6);
  for (const Branch& branch : plant.branches) {
    const MeshPart part = branch_part(plant, branch);
    REQUIRE(part.triangles() == branch.triangles.size());
    std::vector<bool> used(part.vertices.size(), false);
    for (std::size_t i = 0; i < part.indices.size(); ++i) {
      used[part.indices[i]] = true;
      CHECK(corner(part, i) == corner(plant.mesh.bark, 3 * std::size_t{branch.triangles.first} + i));
    }
    CHECK(std::count(used.begin(), used.end(), false) == 0);
  }
}

TEST_CASE("a branch of no triangles stays so") { CHECK(reduced_branch({}, {}, 0.1F).part.indices.empty()); }

}  // namespace manzana::foliage
