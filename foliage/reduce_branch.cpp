#include "foliage/reduce_branch.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

double surface(const MeshPart& part) {
  double sum = 0;
  const auto at = [&](std::size_t i) { return Vec3d(part.vertices[part.indices[i]].position); };
  for (std::size_t i = 0; i < part.indices.size(); i += 3)
    sum += 0.5 * glm::length(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)));
  return sum;
}

Vec3 nearest_on_line(std::span<const CentrePoint> line, const Vec3& p) {
  Vec3 best = line[0].position;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 a = line[i].position, along = line[i + 1].position - a;
    const float length2 = glm::dot(along, along);
    const Vec3 q = a + along * (length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0F, 1.0F) : 0);
    if (glm::length(p - q) < glm::length(p - best)) best = q;
  }
  return best;
}

/// Returns how far a vertex went at most.
float widen(MeshPart& part, std::span<const CentrePoint> line, float f) {
  float moved = 0;
  for (MeshVertex& v : part.vertices) {
    const Vec3 step = (v.position - nearest_on_line(line, v.position)) * (f - 1);
    v.position += step;
    moved = std::max(moved, glm::length(step));
  }
  return moved;
}

}  // namespace

MeshPart branch_part(const Plant& plant, const Branch& branch) {
  const auto all = std::span(plant.mesh.bark.indices)
                       .subspan(3 * std::size_t{branch.triangles.first}, 3 * std::size_t{branch.triangles.size()});
  std::vector<std::uint32_t> used(all.begin(), all.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  MeshPart part;
  for (const std::uint32_t i : used) part.vertices.push_back(plant.mesh.bark.vertices[i]);
  for (const std::uint32_t i : all)
    part.indices.push_back(static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), i) - used.begin()));
  return part;
}

Reduced reduced_branch(const MeshPart& part, std::span<const CentrePoint> line, float error_m) {
  constexpr double kMostWider = 1.2;  // a triangle left of a hexagon needs 1.16; more is needed where it went to pieces
  const double before = surface(part);
  for (int attempt = 0; attempt < 4; ++attempt, error_m *= 0.5F) {
    Reduced reduced = simplified_within(part, error_m);
    const double after = surface(reduced.part);
    if (!(before <= kMostWider * after)) continue;
    if (!line.empty() && before > after)
      reduced.error_m += widen(reduced.part, line, static_cast<float>(before / after));
    return reduced;
  }
  return {part, 0};
}

}  // namespace manzana::foliage
