#pragma once
/// Plants of as little, and of as much, as there can be.
#include <cmath>

#include "foliage/prepare.h"
#include "foliage/random.h"

namespace manzana::draw {

/// One leaf on nothing: a card of two triangles, or half of it.
inline foliage::PreparedPlant single_leaf(bool whole) {
  foliage::Plant plant;
  plant.name = "leaf";
  const auto corner = [](float x, float z) { return foliage::MeshVertex{{x - 0.5F, 0, z}, {0, -1, 0}, {x, 1 - z}}; };
  plant.mesh.leaves.vertices = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
  plant.mesh.leaves.indices = {0, 1, 2};
  if (whole) plant.mesh.leaves.indices.insert(plant.mesh.leaves.indices.end(), {0, 2, 3});
  plant.terminals = {{.triangles = {0, whole ? 2U : 1U}}};
  plant.leaf_image.size = 1;
  plant.leaf_image.rgba = {60, 130, 40, 255};
  plant.bark_image = plant.leaf_image;
  return prepare(plant);
}

/// Cards all through a crown, so many that they cover it many times.
inline foliage::Plant many_cards(std::uint32_t cards) {
  constexpr float kSide = 0.02F;
  foliage::Plant plant;
  plant.name = "cards";
  plant.mesh.leaves.vertices.reserve(std::size_t{4} * cards);
  plant.mesh.leaves.indices.reserve(std::size_t{6} * cards);
  foliage::Random random(1);
  for (std::uint32_t i = 0; i < cards; ++i) {
    const float angle = 6.2831853F * random.uniform(), up = 2 * random.uniform() - 1, out = std::cbrt(random.uniform());
    const Vec3 radial(std::sqrt(1 - up * up) * std::cos(angle), std::sqrt(1 - up * up) * std::sin(angle), up);
    const Vec3 middle = Vec3(0, 0, 6) + 4 * out * radial;
    const Vec3 u = kSide * glm::normalize(glm::cross(radial, Vec3(0.1F, random.uniform(), 1))),
               v = glm::cross(radial, u);
    for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
      plant.mesh.leaves.vertices.push_back({middle + at.x * u + at.y * v, radial, at});
    for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) plant.mesh.leaves.indices.push_back(4 * i + k);
    plant.terminals.push_back({.triangles = {2 * i, 2 * i + 2}});
  }
  plant.leaf_image.size = 1;
  plant.leaf_image.rgba = {60, 130, 40, 255};
  plant.bark_image = plant.leaf_image;
  return plant;
}

}  // namespace manzana::draw
