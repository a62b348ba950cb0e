#include "culling/baselines/exact_planes.h"

#include <cmath>

namespace manzana::culling {
namespace {

BigPlane to_length_1(const Big3& normal, const Big& offset) {
  const Big size = length(normal);
  return size == 0 ? BigPlane{} : BigPlane{(1 / size) * normal, offset / size};
}

using BigRow = std::array<Big, 4>;

/// Row i of projection * view, unrounded.
BigRow row(const Mat4d& projection, const Mat4d& view, int i) {
  BigRow sum{};
  for (int column = 0; column < 4; ++column)
    for (int k = 0; k < 4; ++k) sum[static_cast<std::size_t>(column)] += Big(projection[k][i]) * Big(view[column][k]);
  return sum;
}

/// a * u + b * v as a plane relative to the eye.
BigPlane combine(int a, const BigRow& u, int b, const BigRow& v, const Vec3d& eye) {
  const auto at = [&](std::size_t i) -> Big { return a * u[i] + b * v[i]; };
  const Big3 normal{at(0), at(1), at(2)};
  return to_length_1(normal, dot(normal, big(eye)) + at(3));
}

}  // namespace

BigPlanes exact_planes(const View& view) {
  const Big3 right = big(view.right), up = big(view.up), forward = big(view.forward);
  const auto side = [&](const Big3& across, double tangent, int sign) {
    return to_length_1(Big(sign) * (across - Big(tangent) * forward), 0);
  };
  BigPlanes planes{side(right, view.tan_left, 1), side(right, view.tan_right, -1), side(up, view.tan_bottom, 1),
                   side(up, view.tan_top, -1), to_length_1(forward, -Big(view.near_m))};
  if (std::isfinite(view.far_m)) planes[kFar] = to_length_1(Big(-1) * forward, Big(view.far_m));
  return planes;
}

BigPlanes exact_planes(const Mat4d& projection, const Mat4d& view, ClipDepth depth, const Vec3d& eye) {
  const BigRow x = row(projection, view, 0), y = row(projection, view, 1);
  const BigRow z = row(projection, view, 2), w = row(projection, view, 3);
  BigPlanes planes{combine(1, w, 1, x, eye), combine(1, w, -1, x, eye), combine(1, w, 1, y, eye),
                   combine(1, w, -1, y, eye)};
  const BigPlane less = combine(1, w, -1, z, eye), more = combine(1, w, 1, z, eye), alone = combine(0, w, 1, z, eye);
  planes[kNear] = depth == ClipDepth::minus_one_to_one ? more : depth == ClipDepth::zero_to_one ? alone : less;
  planes[kFar] = depth == ClipDepth::reversed ? alone : less;
  return planes;
}

}  // namespace manzana::culling
