#pragma once
/// What a plant's bark hides, seen from far away: an oracle for coverage. No depth, no perspective, no shading.
#include <algorithm>
#include <cmath>
#include <vector>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

class OrthoMask {
 public:
  /// Looks along a unit direction at a square of `side` metres round `middle`.
  OrthoMask(const Vec3& direction, const Vec3& middle, float side, int pixels)
      : direction_(direction), middle_(middle), scale_(static_cast<float>(pixels) / side), pixels_(pixels) {
    across_ = glm::normalize(glm::cross(direction, std::abs(direction.z) < 0.9F ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
    up_ = glm::cross(across_, direction);
    hit_.assign(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels), 0);
  }

  void triangle(const Vec3& a, const Vec3& b, const Vec3& c) { fill(place(a), place(b), place(c)); }

  void quad(const PlantQuad& quad) {
    const auto& c = quad.corners;
    triangle(c[0].position, c[1].position, c[2].position);
    triangle(c[0].position, c[2].position, c[3].position);
  }

  /// As a ribbon that turns to the eye.
  void line(const Vec3& a, float radius_a, const Vec3& b, float radius_b) {
    const Vec3 side = glm::cross(b - a, direction_);
    if (!(glm::length(side) > 0)) return;
    const Vec3 s = glm::normalize(side);
    triangle(a - s * radius_a, a + s * radius_a, b + s * radius_b);
    triangle(a - s * radius_a, b + s * radius_b, b - s * radius_b);
  }

  void line(const LineSegment& l) { line(l.a, l.radius_a, l.b, l.radius_b); }

  double area_m2() const {
    return static_cast<double>(std::count(hit_.begin(), hit_.end(), 1)) / static_cast<double>(scale_ * scale_);
  }

  /// Share of the pixels of both that only one of them covers.
  double difference(const OrthoMask& other) const {
    double apart = 0, all = 0;
    for (std::size_t i = 0; i < hit_.size(); ++i) apart += hit_[i] != other.hit_[i], all += hit_[i] | other.hit_[i];
    return all > 0 ? apart / all : 0;
  }

 private:
  Vec2 place(const Vec3& p) const {
    const Vec3 d = p - middle_;
    return Vec2(glm::dot(d, across_), glm::dot(d, up_)) * scale_ + Vec2(0.5F * static_cast<float>(pixels_));
  }

  void fill(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 ab = b - a, ac = c - a;
    const float area = ab.x * ac.y - ab.y * ac.x;
    if (area == 0) return;
    const Vec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
    const auto pixel = [&](float v) {
      return static_cast<int>(std::clamp(std::ceil(v - 0.5F), 0.0F, static_cast<float>(pixels_)));
    };
    for (int y = pixel(low.y); y < pixel(high.y); ++y) {
      for (int x = pixel(low.x); x < pixel(high.x); ++x) {
        const Vec2 p = Vec2(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - a;
        const float v = (p.x * ac.y - p.y * ac.x) / area, w = (ab.x * p.y - ab.y * p.x) / area;
        if (v >= 0 && w >= 0 && v + w <= 1) hit_[static_cast<std::size_t>(y * pixels_ + x)] = 1;
      }
    }
  }

  Vec3 direction_, middle_, across_, up_;
  float scale_;
  int pixels_;
  std::vector<char> hit_;
};

/// `count` directions spread over the sphere. [Fibonacci lattice]
inline std::vector<Vec3> spread_directions(int count) {
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i) {
    const float z = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(count);
    const float r = std::sqrt(1 - z * z), angle = 2.399963F * static_cast<float>(i);
    out.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return out;
}

}  // namespace manzana::foliage
