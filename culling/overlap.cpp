#include "culling/overlap.h"

#include <cfloat>
#include <cmath>

namespace manzana::culling {

Overlap overlap_of_empty(const Box& box) {
  const bool nan = glm::any(glm::isnan(box.min)) || glm::any(glm::isnan(box.max));
  return nan ? Overlap::crosses : Overlap::outside;
}

bool overlaps(const Sphere& sphere, const Box& box) {
  if (sphere.empty()) return false;
  if (box.empty()) return overlap_of_empty(box) == Overlap::crosses;
  // Squares of floats neither overflow nor vanish in double.
  const Vec3d c(sphere.center);
  const Vec3d gap = c - glm::clamp(c, Vec3d(box.min), Vec3d(box.max));
  const double r = static_cast<double>(sphere.radius);
  return !(glm::dot(gap, gap) > r * r * (1 + 8 * DBL_EPSILON));
}

}  // namespace manzana::culling
