#include "foliage/import/polygon.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t kMostEars = 64;  // corners: cutting ears takes their square

std::vector<Triangle> fan(std::size_t corners) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 2; i < corners; ++i) triangles.push_back({0, i - 1, i});
  return triangles;
}

/// Into the plane across the normal's longest axis, so that the polygon turns left.
std::vector<Vec2d> flattened(std::span<const Vec3d> corners, const Vec3d& normal) {
  const Vec3d size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Vec2d> flat;
  for (const Vec3d& c : corners) flat.emplace_back(sign * c[(axis + 1) % 3], c[(axis + 2) % 3]);
  return flat;
}

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class EarCutter {
 public:
  explicit EarCutter(std::vector<Vec2d> corners) : corners_(std::move(corners)), left_(corners_.size()) {
    for (std::uint32_t i = 0; i < left_.size(); ++i) left_[i] = i;
  }

  bool convex() const {
    for (std::size_t i = 0; i < left_.size(); ++i)
      if (turn_at(i) < 0) return false;
    return true;
  }

  /// Fewer than corners - 2 when it finds no ear any more: the polygon crosses itself.
  std::vector<Triangle> run() {
    std::vector<Triangle> triangles;
    for (std::size_t at = 0, misses = 0; left_.size() >= 3 && misses < left_.size();) {
      at %= left_.size();
      if (!is_ear(at)) {
        ++at, ++misses;
        continue;
      }
      triangles.push_back({left_[before(at)], left_[at], left_[after(at)]});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      misses = 0;
    }
    return triangles;
  }

 private:
  std::size_t before(std::size_t i) const { return (i + left_.size() - 1) % left_.size(); }
  std::size_t after(std::size_t i) const { return (i + 1) % left_.size(); }
  const Vec2d& corner(std::size_t i) const { return corners_[left_[i]]; }
  double turn_at(std::size_t i) const { return turn(corner(before(i)), corner(i), corner(after(i))); }

  bool is_ear(std::size_t i) const {
    if (turn_at(i) < 0) return false;
    const Vec2d &a = corner(before(i)), &b = corner(i), &c = corner(after(i));
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const Vec2d& p = corner(k);
      if (p == a || p == b || p == c || turn_at(k) >= 0) continue;  // only a reentrant corner can lie within
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::vector<Vec2d> corners_;
  std::vector<std::uint32_t> left_;
};

}  // namespace

Vec3d area_vector(std::span<const Vec3d> corners) {
  Vec3d sum(0);
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

std::vector<Triangle> triangulated(std::span<const Vec3d> corners) {
  if (corners.size() < 3) return {};
  if (corners.size() == 3 || corners.size() > kMostEars) return fan(corners.size());
  EarCutter cutter(flattened(corners, area_vector(corners)));
  if (cutter.convex()) return fan(corners.size());
  std::vector<Triangle> ears = cutter.run();
  return ears.size() + 2 == corners.size() ? ears : fan(corners.size());
}

}  // namespace manzana::foliage
