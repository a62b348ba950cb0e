#include "foliage/import/source_part.h"

#include <cmath>

namespace manzana::foliage {

std::vector<Vec3> computed_normals(const SourcePart& part) {
  std::vector<Vec3d> sums(part.positions.size(), Vec3d(0));
  for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3) {
    const Vec3d &a = part.positions[part.indices[t]], &b = part.positions[part.indices[t + 1]];
    const Vec3d n = glm::cross(b - a, part.positions[part.indices[t + 2]] - a);
    for (std::size_t k = 0; k < 3; ++k) sums[part.indices[t + k]] += n;
  }
  std::vector<Vec3> out;
  for (const Vec3d& sum : sums) {
    const double length = glm::length(sum);
    out.push_back(length > 0 && std::isfinite(length) ? Vec3(sum / length) : Vec3(0, 0, 1));
  }
  return out;
}

}  // namespace manzana::foliage
