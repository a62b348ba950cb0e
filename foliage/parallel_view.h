#pragma once
/// A plant seen by parallel rays, in a square picture: for fitting, for counting, on the CPU and the GPU.
///   const ParallelView view = view_of(plant, to_eye, 256);
///   view.pixel(corner), view.nearness(corner);
#include <cmath>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Columns and rows; pixel centres are at halves.
class ParallelView {
 public:
  /// Of a ball. `to_eye`: unit.
  ParallelView(const Vec3d& to_eye, const Vec3& centre, float radius, int pixels)
      : centre_(centre),
        towards_(to_eye),
        radius_(radius),
        pixels_(pixels),
        scale_(static_cast<float>(pixels) / (2 * radius)) {
    // Of the coordinate axes the one that is most across.
    const Vec3d other = std::abs(to_eye.z) < 0.9 ? Vec3d(0, 0, 1) : Vec3d(1, 0, 0);
    right_ = Vec3(glm::normalize(glm::cross(other, to_eye)));
    up_ = Vec3(glm::cross(to_eye, Vec3d(right_)));
  }

  /// What lies round `middle`, a place in this picture, `zoom` times as large.
  ParallelView part(const Vec2& middle, float zoom, int pixels) const {
    ParallelView out = *this;
    const Vec2 across = (middle - Vec2(0.5F * static_cast<float>(pixels_))) / scale_;
    out.centre_ += right_ * across.x + up_ * across.y;
    out.scale_ *= zoom;
    out.pixels_ = pixels;
    return out;
  }

  /// The same rays seen from their other end: a picture that is mirrored left to right.
  ParallelView turned() const {
    ParallelView out = *this;
    out.right_ = -right_;
    out.towards_ = -towards_;
    return out;
  }

  int pixels() const { return pixels_; }
  const Vec3& centre() const { return centre_; }
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& towards() const { return towards_; }
  float radius() const { return radius_; }  ///< m: everything is nearer to the centre, along `towards`
  Vec2 pixel(const Vec3& p) const {
    const Vec3 d = p - centre_;
    return Vec2(glm::dot(d, right_), glm::dot(d, up_)) * scale_ + Vec2(0.5F * static_cast<float>(pixels_));
  }
  float pixels_of(float metres) const { return metres * scale_; }
  float nearness(const Vec3& p) const { return glm::dot(p - centre_, towards_); }  ///< m towards the eye

 private:
  Vec3 centre_, right_, up_, towards_;
  float radius_;
  int pixels_;
  float scale_;
};

/// Bark as it is at its best.
inline Run finest_bark(const PreparedPlant& plant) {
  if (plant.branch_levels.empty()) return {0, static_cast<std::uint32_t>(plant.bark.size())};
  return plant.branch_levels[0].quads;
}

/// Of the ball round all corners, `margin` times as large.
inline ParallelView view_of(const PreparedPlant& plant, const Vec3d& to_eye, int pixels, float margin = 1) {
  Vec3 low(3e38F), high(-3e38F);
  for (const auto* part : {&plant.bark, &plant.leaves})
    for (const PlantQuad& quad : *part)
      for (const PlantQuad::Corner& c : quad.corners)
        low = glm::min(low, c.position), high = glm::max(high, c.position);
  return {to_eye, 0.5F * (low + high), std::max(0.5F * margin * glm::length(high - low), 1e-6F), pixels};
}

}  // namespace manzana::foliage
