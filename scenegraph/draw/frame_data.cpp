#include "scenegraph/draw/frame_data.h"

#include <algorithm>
#include <cmath>

namespace manzana::draw {
namespace {

using Vec4d = glm::dvec4;

Vec4 narrow(const Vec3d& v, double w = 0) { return {Vec3(v), static_cast<float>(w)}; }

// Noise repeats every 1024 lattice cells of 64 m: within that, float places are good to 4 mm.
constexpr double kNoisePeriod = 65536;

double wrap(double x) { return x - kNoisePeriod * std::floor(x / kNoisePeriod); }

/// What light passes on its way: so many times what it does from straight above. [Kasten, Young 1989, equation 3]
double air_mass(double sin_height) {
  const double height_deg = glm::degrees(std::asin(std::clamp(sin_height, 0.0, 1.0)));
  return 1 / (std::sin(glm::radians(height_deg)) + 0.50572 * std::pow(height_deg + 6.07995, -1.6364));
}

/// The lights below are those of a sun that is so high; a lower one goes through more air, which takes the blue first.
constexpr double kSunHeight = 0.7;
Vec3 through_air(double sin_height) {
  const double more = air_mass(sin_height) - air_mass(kSunHeight);
  return Vec3(std::exp(-0.05 * more), std::exp(-0.11 * more), std::exp(-0.24 * more));
}

/// The sky's light is what the air took, from above and from the horizon: less of it, and warmer, under a low sun.
Vec3 of_sky(double sin_height) {
  const double less = std::min(0.0, sin_height - kSunHeight);
  return Vec3(std::exp(1.1 * less), std::exp(1.3 * less), std::exp(1.4 * less));
}

}  // namespace

Rows relative_to(const Vec3d& eye, const BlockFrame& block) {
  const Vec3d origin = block.origin - eye;
  Rows rows;
  for (int i = 0; i < 3; ++i) {
    rows[static_cast<std::size_t>(i)] = Vec4(Vec4d(block.axes[0][i], block.axes[1][i], block.axes[2][i], origin[i]));
  }
  return rows;
}

Vec3d sun_direction(double azimuth_deg, double elevation_deg) {
  const double azimuth = glm::radians(azimuth_deg), elevation = glm::radians(elevation_deg);
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
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
  const double sun_height = glm::dot(glm::normalize(options.sun), up);
  const Vec3 sky = of_sky(sun_height);
  data.sun_light = Vec4(Vec3(1.75F, 1.62F, 1.38F) * through_air(sun_height), 0);
  data.sky_light = Vec4(Vec3(0.50F, 0.60F, 0.76F) * sky, 0);
  data.ground_light = Vec4(Vec3(0.24F, 0.23F, 0.20F) * sky, 0);
  data.horizon = Vec4(Vec3(0.80F, 0.93F, 1.08F) * sky, 0);
  data.zenith = Vec4(Vec3(0.13F, 0.30F, 0.72F) * sky, 0);
  data.fog.x = options.layers.fog ? static_cast<float>(1 / options.fog_distance_m) : 0.0F;
  const Vec3d place = anchor.to_block(camera.eye);
  data.ground_x = narrow(anchor.axes[0], wrap(place.x));
  data.ground_y = narrow(anchor.axes[1], wrap(place.y));
  return data;
}

}  // namespace manzana::draw
