#pragma once
/// Small plants made by hand.
#include "foliage/plant.h"
#include "foliage/random.h"
#include "foliage/tube.h"

namespace manzana::foliage {

/// A branch with a straight tube round its line, which tapers to a point.
inline void add_straight_branch(Plant& plant, std::int32_t parent, const Vec3& foot, const Vec3& tip, float radius,
                                int rings = 4, int sides = 6) {
  const Vec3 heading = glm::normalize(tip - foot);
  const Vec3 across = glm::normalize(glm::cross(heading, std::abs(heading.z) < 0.9F ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
  const Mat3 frame{across, glm::cross(heading, across), heading};
  Branch branch;
  branch.parent = parent;
  branch.level =
      parent < 0 ? 0 : static_cast<std::uint16_t>(plant.branches[static_cast<std::size_t>(parent)].level + 1);
  branch.line.first = static_cast<std::uint32_t>(plant.centre_lines.size());
  branch.triangles.first = static_cast<std::uint32_t>(plant.mesh.bark.triangles());
  std::vector<StemPoint> points;
  for (int i = 0; i <= rings; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(rings);
    points.push_back({glm::mix(foot, tip, t), frame, radius * (1 - t)});
    plant.centre_lines.push_back({points.back().position, points.back().radius});
  }
  add_tube(plant.mesh.bark, points, glm::length(tip - foot), sides, 1);
  branch.line.last = static_cast<std::uint32_t>(plant.centre_lines.size());
  branch.triangles.last = static_cast<std::uint32_t>(plant.mesh.bark.triangles());
  plant.branches.push_back(branch);
}

/// A trunk of 8 m and `count` branches on it, thinner and thinner, in a spiral.
inline Plant spiral_plant(std::uint32_t count) {
  Plant plant;
  plant.name = "spiral";
  add_straight_branch(plant, -1, {0, 0, 0}, {0, 0, 8}, 0.2F);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(count),
                angle = 2.4F * static_cast<float>(i);
    const Vec3 foot(0, 0, 1 + 6 * share);
    const Vec3 out = Vec3(std::cos(angle), std::sin(angle), 0.5F) * (3 * (1.1F - share));
    add_straight_branch(plant, 0, foot, foot + out, 0.1F * (1.05F - share));
  }
  return plant;
}

/// So many upright leaves `wide` across and .4 m high on a ground of 4 m by 4, and nothing else.
inline Plant leaves_on_ground(std::uint32_t count, float wide, std::uint64_t seed) {
  Plant plant;
  Random random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float x = random.spread(2), y = random.spread(2), angle = random.spread(3.14F);
    const Vec3 across(wide * std::cos(angle), wide * std::sin(angle), 0);
    std::array<MeshVertex, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k].position = Vec3(x, y, k < 2 ? 0 : .4F) + (k % 3 == 0 ? 0.F : 1.F) * across;
      corners[k].normal = {-std::sin(angle), std::cos(angle), 0};
    }
    add_quad(plant.mesh.leaves, corners);
    plant.terminals.push_back({{2 * i, 2 * i + 2}, -1, Organ::leaf});
  }
  return plant;
}

}  // namespace manzana::foliage
