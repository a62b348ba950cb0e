#include "culling/baselines/pushed_planes.h"

namespace manzana::baselines {

Vec3 reach_of(std::span<const culling::Box> boxes) {
  Vec3 reach(0);
  for (const culling::Box& box : boxes) reach = glm::max(reach, glm::max(glm::abs(box.min), glm::abs(box.max)));
  return reach;
}

namespace {

/// The most likely to reject come first, for tests that end with the first plane that does.
constexpr std::array kOrder{culling::kFar,    culling::kLeft, culling::kRight,
                            culling::kBottom, culling::kTop,  culling::kNear};

void push_out(const culling::Plane& plane, float slack, const Vec3& reach, PushedPlane& pushed) {
  const auto& [n, offset] = plane;
  const Vec3 sizes = glm::abs(n) * reach;
  // Twice the margin of overlap.h, for the sums in another order and the sum with the margin itself.
  const float margin = 2 * culling::kMargin * (sizes.x + sizes.y + sizes.z + glm::abs(offset)) + 2 * slack;
  pushed.normal = n;
  pushed.outer = offset + margin;
  pushed.inner = offset - margin;
  pushed.best = {n.x >= 0 ? 3U : 0U, n.y >= 0 ? 4U : 1U, n.z >= 0 ? 5U : 2U};
  pushed.worst = {3U - pushed.best[0], 5U - pushed.best[1], 7U - pushed.best[2]};
}

}  // namespace

PushedPlanes push_out(const culling::Frustum& frustum, const Vec3& reach) {
  PushedPlanes pushed;
  for (const std::size_t k : kOrder)
    if (k < static_cast<std::size_t>(frustum.count))
      push_out(frustum.planes[k], frustum.slack[k], reach, pushed.planes[pushed.count++]);
  return pushed;
}

}  // namespace manzana::baselines
