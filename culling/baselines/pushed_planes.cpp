#include "culling/baselines/pushed_planes.h"

namespace manzana::baselines {

Vec3 reach_of(std::span<const culling::Box> boxes) {
  Vec3 reach(0);
  for (const culling::Box& box : boxes) reach = glm::max(reach, glm::max(glm::abs(box.min), glm::abs(box.max)));
  return reach;
}

PushedPlanes push_out(const culling::Frustum& frustum, const Vec3& reach) {
  PushedPlanes pushed;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const auto& [normal, offset] = frustum.planes[k];
    const Vec3 sizes = glm::abs(normal) * reach;
    // Twice the margin of overlap.h, for the sums in another order and the sum with the margin itself.
    const float margin = 2 * culling::kMargin * (sizes.x + sizes.y + sizes.z + glm::abs(offset)) + 2 * frustum.slack[k];
    pushed.planes[pushed.count++] = {normal, offset + margin, offset - margin};
  }
  return pushed;
}

}  // namespace manzana::baselines
