#include "scenegraph/draw/frame_data.h"

#include <cmath>

namespace manzana::draw {
namespace {

using Vec4d = glm::dvec4;

Vec4 narrow(const Vec3d& v, double w = 0) { return {Vec3(v), static_cast<float>(w)}; }

// Noise repeats every 1024 lattice cells of 64 m: within that, float places are good to 4 mm.
constexpr double kNoisePeriod = 65536;

double wrap(double x) { return x - kNoisePeriod * std::floor(x / kNoisePeriod); }

}  // namespace

Rows relative_to(const Vec3d& eye, const BlockFrame& block) {
  const Vec3d origin = block.origin - eye;
  Rows rows;
  for (int i = 0; i < 3; ++i) {
    rows[static_cast<std::size_t>(i)] = Vec4(Vec4d(block.axes[0][i], block.axes[1][i], block.axes[2][i], origin[i]));
  }
  return rows;
}

FrameData make_frame(const LocalFrame& frame, const Camera& camera, const DrawOptions& options,
                     const BlockFrame& anchor) {
  const Vec2d plan(camera.eye);
  const Vec3d up = frame.up_at(plan);
  const Vec3d ground(plan, frame.ground_z(plan));
  FrameData data{};
  data.view_projection = Mat4(camera.view_projection);
  data.ray_forward = narrow(camera.ray_forward);
  data.ray_right = narrow(camera.ray_right);
  data.ray_up = narrow(camera.ray_up);
  data.up = narrow(up, glm::dot(camera.eye - ground, up));
  data.sun = narrow(glm::normalize(options.sun));
  data.sun_light = {1.75F, 1.62F, 1.38F, 0};
  data.sky_light = {0.50F, 0.60F, 0.76F, 0};
  data.ground_light = {0.24F, 0.23F, 0.20F, 0};
  data.horizon = {0.80F, 0.93F, 1.08F, 0};
  data.zenith = {0.13F, 0.30F, 0.72F, 0};
  data.fog.x = options.layers.fog ? static_cast<float>(1 / options.fog_distance_m) : 0.0F;
  const Vec3d place = anchor.to_block(camera.eye);
  data.ground_x = narrow(anchor.axes[0], wrap(place.x));
  data.ground_y = narrow(anchor.axes[1], wrap(place.y));
  return data;
}

}  // namespace manzana::draw
