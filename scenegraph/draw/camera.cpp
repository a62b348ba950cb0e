#include "scenegraph/draw/camera.h"

#include <cmath>

namespace manzana::draw {
namespace {

using Vec4d = glm::dvec4;
using culling::ClipDepth;

Vec4d row(const Mat4d& m, int i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

Mat4d from_rows(const Vec4d& x, const Vec4d& y, const Vec4d& z, const Vec4d& w) {
  return glm::transpose(Mat4d(x, y, z, w));
}

/// A clip row whose quotient by w goes from 1 at the host's near plane to 0 at its far one.
Vec4d reversed(const Vec4d& z, const Vec4d& w, ClipDepth depth) {
  if (depth == ClipDepth::reversed) return z;
  return depth == ClipDepth::zero_to_one ? w - z : (w - z) / 2.0;
}

/// Of the near plane, in units of w; of a projection that has none a tenth.
double nearest_w(const Mat4d& projection, ClipDepth depth) {
  const double along = projection[2][3], a = projection[2][2] / along, b = projection[3][2];
  const double at_near = depth == ClipDepth::minus_one_to_one ? -1 : depth == ClipDepth::zero_to_one ? 0 : 1;
  const double w = b / (at_near - a);
  return std::isfinite(w) && w > 0 ? w : 0.1 * std::abs(along);
}

/// Of x, y and w along the axes: a pixel's ray is what they turn (x, y, 1) back into, a metre ahead.
void set_rays(Camera& camera, const glm::dmat3& clip) {
  const glm::dmat3 back = glm::inverse(clip);
  const double ahead = glm::length(Vec3d(clip[0][2], clip[1][2], clip[2][2]));
  camera.ray_right = back[0] * ahead;
  camera.ray_up = back[1] * ahead;
  camera.ray_forward = back[2] * ahead;
}

glm::dmat3 linear_part(const Vec4d& x, const Vec4d& y, const Vec4d& w) {
  return glm::transpose(glm::dmat3(Vec3d(x), Vec3d(y), Vec3d(w)));
}

void set_perspective(Camera& camera, const Mat4d& projection, const Mat4d& clip, ClipDepth depth) {
  const Vec4d x(Vec3d(row(clip, 0)), 0), y(Vec3d(row(clip, 1)), 0), w(Vec3d(row(clip, 3)), 0);
  camera.view_projection = from_rows(x, y, {0, 0, 0, nearest_w(projection, depth)}, w) / glm::length(w);
  const glm::dmat3 linear = linear_part(x, y, w);
  camera.mirrored = glm::determinant(linear) > 0;
  set_rays(camera, linear);
}

/// Behind by so many pixels that a picture's width does not count, and near enough for floats to place things to a
/// thousandth of a pixel.
constexpr double kBehindPx = 1e5;

void set_orthographic(Camera& camera, const Mat4d& of_any_scale, ClipDepth depth, double height_px) {
  const Mat4d clip = of_any_scale / of_any_scale[3][3];
  const Vec3d y(row(clip, 1)), z(reversed(row(clip, 2), row(clip, 3), depth));
  const Vec3d forward = -glm::normalize(z);
  const double metres_a_pixel = 2 / (glm::length(y) * height_px), behind = kBehindPx * metres_a_pixel;
  camera.orthographic = true;
  camera.eye -= forward * behind;
  const Vec4d eye(camera.eye, 1);
  const auto moved = [&](const Vec4d& r) { return Vec4d(Vec3d(r), glm::dot(r, eye)); };
  camera.view_projection = from_rows(moved(row(clip, 0)), moved(row(clip, 1)),
                                     moved(reversed(row(clip, 2), row(clip, 3), depth)), row(clip, 3)) *
                           behind;
  const glm::dmat3 linear = linear_part(row(clip, 0), row(clip, 1), Vec4d(forward, 0));
  camera.mirrored = glm::determinant(linear) > 0;
  set_rays(camera, linear);
  camera.ray_right /= behind;
  camera.ray_up /= behind;
}

}  // namespace

Camera camera_of(const culling::View& view) {
  const double width = view.tan_right - view.tan_left, height = view.tan_top - view.tan_bottom;
  const double shift_x = (view.tan_right + view.tan_left) / width, shift_y = (view.tan_top + view.tan_bottom) / height;
  Camera camera;
  camera.eye = view.eye;
  camera.view_projection =
      from_rows({view.right * (2 / width) - view.forward * shift_x, 0},
                {view.up * (2 / height) - view.forward * shift_y, 0}, {0, 0, 0, view.near_m}, {view.forward, 0});
  camera.ray_forward = view.forward + view.right * (shift_x * width / 2) + view.up * (shift_y * height / 2);
  camera.ray_right = view.right * (width / 2);
  camera.ray_up = view.up * (height / 2);
  camera.frustum = make_frustum(view);
  camera.mirrored = glm::dot(glm::cross(view.forward, view.up), view.right) < 0;
  return camera;
}

Camera camera_of(const Mat4d& projection, const Mat4d& view, ClipDepth depth, double height_px) {
  Camera camera;
  camera.frustum = make_frustum(projection, view, depth).frustum;
  camera.eye = Vec3d(glm::inverse(view)[3]);
  const Mat4d clip = projection * view;
  if (Vec3d(row(projection, 3)) == Vec3d(0))
    set_orthographic(camera, clip, depth, height_px);
  else
    set_perspective(camera, projection, clip, depth);
  return camera;
}

culling::PlaneD near_plane(const Camera& camera) {
  return {Vec3d(row(camera.view_projection, 3)), -camera.view_projection[3][2]};
}

double focal_px(const Camera& camera, double height_px) { return height_px / (2 * glm::length(camera.ray_up)); }

}  // namespace manzana::draw
