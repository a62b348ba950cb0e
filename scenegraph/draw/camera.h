#pragma once
/// What a picture is taken with, whoever made it: a View of ours, or the matrices of a host, perspective or
/// orthographic, off the axis, mirrored, with any depth. Drawn with a depth of our own, reversed: 1 near, 0 far.
///   const Camera camera = camera_of(view);
///   const Camera hosts = camera_of(projection, view_matrix, culling::ClipDepth::minus_one_to_one, height_px);
#include "culling/frustum.h"
#include "culling/host_camera.h"

namespace manzana::draw {

/// In L, metres.
struct Camera {
  Vec3d eye{0};                ///< drawn positions are relative to it. Of an orthographic view: far behind, so that the
                               ///< distance from it, on which detail depends, is about the same for all that is seen
  Mat4d view_projection{1};    ///< of positions relative to the eye; reversed depth; w: metres along the view, of an
                               ///< orthographic one the distance of its eye
  Vec3d ray_forward{0, 1, 0};  ///< the ray of a pixel is forward + x right + y up, with x and y in -1..1
  Vec3d ray_right{1, 0, 0}, ray_up{0, 0, 1};
  culling::FrustumD frustum;
  bool mirrored = false;
  bool orthographic = false;
};

Camera camera_of(const culling::View& view);

/// As culling/host_camera.h takes them; of a perspective one the apex is the view's origin. What is singular sees
/// nothing. `height_px`: of the picture, for the distance of an orthographic eye.
Camera camera_of(const Mat4d& projection, const Mat4d& view, culling::ClipDepth depth, double height_px);

/// Of a perspective one, relative to the eye: what lies before it is not drawn.
culling::PlaneD near_plane(const Camera& camera);

/// Pixels of a metre at a distance of a metre, in a picture of that height.
double focal_px(const Camera& camera, double height_px);

}  // namespace manzana::draw
