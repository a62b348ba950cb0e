#pragma once
/// Points in a turned box somewhere: for boxes and their oracles.
#include <vector>

#include "culling/vec.h"
#include "foliage/random.h"

namespace manzana::foliage {

using Points = std::vector<Vec3d>;

inline Points random_points(std::size_t count, const Vec3d& size, const Mat3d& turn, const Vec3d& place,
                            std::uint64_t seed) {
  Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3d p;
    for (int k = 0; k < 3; ++k) p[k] = static_cast<double>(random.uniform()) - 0.5;
    points.push_back(turn * (p * size) + place);
  }
  return points;
}

inline Mat3d some_turn() {
  const Vec3d x = glm::normalize(Vec3d(1, 2, -.5)), y = glm::normalize(glm::cross(x, Vec3d(0, 1, 1)));
  return {x, y, glm::cross(x, y)};
}

}  // namespace manzana::foliage
