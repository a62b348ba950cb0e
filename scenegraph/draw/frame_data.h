#pragma once
/// From double to float, once a frame: the camera's matrix, the light, and where each visible block lies.
///   FrameData frame = make_frame(scene.frame, camera, options, scene.blocks[0]);
///   BlockRows rows = relative_to(camera.eye, scene.blocks[b]);
/// Every difference of positions is taken in double and only then cast, so nothing depends on where on the Earth the
/// scene lies [numerics R1, 7.1].
#include <array>

#include "culling/vec.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

namespace glsl {
using vec4 = glm::vec4;
using mat4 = glm::mat4;
#include "scenegraph/draw/shaders/frame_layout.glsl"
}  // namespace glsl
using glsl::FrameData;
static_assert(sizeof(FrameData) == 64 + 13 * 16);  // std140

/// A rigid or scaled placement, relative to the eye: p -> (dot(row[i].xyz, p) + row[i].w), metres.
using Rows = std::array<Vec4, 3>;
Rows relative_to(const Vec3d& eye, const BlockFrame& block);
inline Vec3 placed(const Rows& rows, const Vec3& p) {
  const Vec4 q(p, 1.0F);
  return {glm::dot(rows[0], q), glm::dot(rows[1], q), glm::dot(rows[2], q)};
}

/// `anchor`: a fixed frame of the scene, where the noise of the ground begins.
FrameData make_frame(const LocalFrame& frame, const Camera& camera, const DrawOptions& options,
                     const BlockFrame& anchor);

/// Towards a sun that stands over that azimuth, from the north over the east. Unit, in L's axes.
Vec3d sun_direction(double azimuth_deg, double height_deg);

}  // namespace manzana::draw
