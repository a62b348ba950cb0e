#include "culling/baselines/host_matrices.h"

#include <cmath>
#include <tuple>
#include <utility>

namespace manzana::baselines {
namespace {

using culling::ClipDepth;
using culling::View;

Mat4d view_matrix(const View& view) {
  const Vec3d rows[3] = {view.right, view.up, -view.forward};
  Mat4d m(1);
  for (int i = 0; i < 3; ++i) {
    for (int column = 0; column < 3; ++column) m[column][i] = rows[i][column];
    m[3][i] = -glm::dot(rows[i], view.eye);
  }
  return m;
}

/// Of the depth row: the entries of z and 1. View space looks along -z, and w = -z.
std::pair<double, double> perspective_depth(double n, double f, ClipDepth depth) {
  const bool infinite = !std::isfinite(f);
  switch (depth) {
    case ClipDepth::minus_one_to_one:
      return infinite ? std::pair{-1.0, -2 * n} : std::pair{-(f + n) / (f - n), -2 * f * n / (f - n)};
    case ClipDepth::zero_to_one:
      return infinite ? std::pair{-1.0, -n} : std::pair{-f / (f - n), -f * n / (f - n)};
    case ClipDepth::reversed:
      return infinite ? std::pair{0.0, n} : std::pair{n / (f - n), f * n / (f - n)};
  }
  return {};
}
std::pair<double, double> parallel_depth(double n, double f, ClipDepth depth) {
  switch (depth) {
    case ClipDepth::minus_one_to_one:
      return {-2 / (f - n), -(f + n) / (f - n)};
    case ClipDepth::zero_to_one:
      return {-1 / (f - n), -n / (f - n)};
    case ClipDepth::reversed:
      return {1 / (f - n), f / (f - n)};
  }
  return {};
}

}  // namespace

HostMatrices host_matrices(const View& view, ClipDepth depth) {
  const double width = view.tan_right - view.tan_left, height = view.tan_top - view.tan_bottom;
  Mat4d p(0);
  p[0][0] = 2 / width;
  p[2][0] = (view.tan_right + view.tan_left) / width;
  p[1][1] = 2 / height;
  p[2][1] = (view.tan_top + view.tan_bottom) / height;
  p[2][3] = -1;
  std::tie(p[2][2], p[3][2]) = perspective_depth(view.near_m, view.far_m, depth);
  return {p, view_matrix(view), depth};
}

HostMatrices orthographic_matrices(const View& view, double distance, ClipDepth depth) {
  const double width = view.tan_right - view.tan_left, height = view.tan_top - view.tan_bottom;
  Mat4d p(1);
  p[0][0] = 2 / (width * distance);
  p[3][0] = -(view.tan_right + view.tan_left) / width;
  p[1][1] = 2 / (height * distance);
  p[3][1] = -(view.tan_top + view.tan_bottom) / height;
  std::tie(p[2][2], p[3][2]) = parallel_depth(view.near_m, view.far_m, depth);
  return {p, view_matrix(view), depth};
}

}  // namespace manzana::baselines
