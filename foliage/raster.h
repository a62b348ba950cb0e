#pragma once
/// Small pictures of plants on the CPU, for fitting and as an oracle: pixel centres in triangles, holes of leaves by
/// alpha, parallel views from all around.
#include <algorithm>
#include <array>
#include <cmath>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// Columns and rows; visits pixels whose centres lie in the closed triangle, with the weights of corners 1 and 2.
/// Corners in pixels; those outside the picture are cut off.
template <class Visit>  // void(int x, int y, float v, float w)
void for_each_pixel(const std::array<Vec2, 3>& t, int pixels, Visit&& visit) {
  const Vec2 pa = t[0], pb = t[1] - pa, pc = t[2] - pa;
  const float area = pb.x * pc.y - pb.y * pc.x;
  if (std::abs(area) < 1e-9F) return;
  const Vec2 low = glm::min(glm::min(Vec2(0), pb), pc) + pa, high = glm::max(glm::max(Vec2(0), pb), pc) + pa;
  const auto pixel = [&](float v) {
    return static_cast<int>(std::clamp(std::ceil(v - 0.5F), 0.0F, static_cast<float>(pixels)));
  };
  for (int y = pixel(low.y); y < pixel(high.y); ++y) {
    for (int x = pixel(low.x); x < pixel(high.x); ++x) {
      const Vec2 p = Vec2(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - pa;
      const float v = (p.x * pc.y - p.y * pc.x) / area, w = (pb.x * p.y - pb.y * p.x) / area;
      if (v >= 0 && w >= 0 && v + w <= 1) visit(x, y, v, w);
    }
  }
}

/// Where a leaf's picture is leaf: texels with alpha of one half or more. uv repeat. Without a picture, everywhere.
class LeafHoles {
 public:
  explicit LeafHoles(const Image& image) : image_(&image) {}
  bool opaque(const Vec2& uv) const {
    if (image_->size == 0) return true;
    const auto at = [&](float v) {
      return static_cast<std::size_t>(
          std::clamp(static_cast<int>((v - std::floor(v)) * static_cast<float>(image_->size)), 0, image_->size - 1));
    };
    return image_->rgba[4 * (at(uv.y) * static_cast<std::size_t>(image_->size) + at(uv.x)) + 3] >= 128;
  }

 private:
  const Image* image_;
};

/// A square picture by parallel rays, of a ball.
class ParallelView {
 public:
  /// `to_eye`: unit.
  ParallelView(const Vec3d& to_eye, const Vec3& centre, float radius, int pixels)
      : centre_(centre), depth_(to_eye), pixels_(pixels), scale_(static_cast<float>(pixels) / (2 * radius)) {
    // Of the coordinate axes the one that is most across.
    const Vec3d other = std::abs(to_eye.z) < 0.9 ? Vec3d(0, 0, 1) : Vec3d(1, 0, 0);
    right_ = Vec3(glm::normalize(glm::cross(other, to_eye)));
    up_ = Vec3(glm::cross(to_eye, Vec3d(right_)));
  }

  int pixels() const { return pixels_; }
  Vec2 pixel(const Vec3& p) const {
    const Vec3 d = p - centre_;
    return Vec2(glm::dot(d, right_), glm::dot(d, up_)) * scale_ + Vec2(0.5F * static_cast<float>(pixels_));
  }
  float pixels_of(float metres) const { return metres * scale_; }
  float nearness(const Vec3& p) const { return glm::dot(p - centre_, depth_); }  ///< m towards the eye

 private:
  Vec3 centre_, right_, up_, depth_;
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
