#include "foliage/poisson_disk.h"

#include <algorithm>
#include <cmath>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

using Triangle = std::array<Vec3d, 3>;

double area(const Triangle& t) { return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0])); }

class Darts {
 public:
  Darts(std::span<const Triangle> triangles, const PoissonOptions& options)
      : triangles_(triangles), options_(options), random_(options.seed) {
    for (const Triangle& t : triangles) areas_.push_back((areas_.empty() ? 0 : areas_.back()) + area(t));
  }

  std::vector<SurfacePoint> run() {
    constexpr double kDensest = 0.7;  // of A / r^2; thrown disks never get there
    constexpr double kShrink = 0.84;  // fourth root of 1/2: twice the points in four steps
    constexpr int kTries = 30;
    if (triangles_.empty()) return {};
    const double total = areas_.back(), least = options_.least_distance;
    std::uint64_t most = options_.count;
    if (least > 0)
      most = std::min(most, static_cast<std::uint64_t>(std::min(1 + kDensest * total / (least * least), 1e9)));
    for (double distance = std::max(std::sqrt(total), least); points_.size() < most;) {
      int tries = 0;
      while (tries < kTries && !throw_dart(distance)) ++tries;
      if (tries < kTries) continue;
      if (distance <= least) break;
      distance = std::max(distance * kShrink, least);
    }
    return points_;
  }

 private:
  double draw() { return static_cast<double>(random_.bits() >> 11) * 0x1p-53; }

  bool throw_dart(double distance) {
    const double at = draw() * areas_.back();
    const auto found = std::upper_bound(areas_.begin(), areas_.end(), at);
    const auto which = static_cast<std::size_t>(std::min(found - areas_.begin(), std::ssize(areas_) - 1));
    Vec2d place{draw(), draw()};
    if (place.x + place.y > 1) place = Vec2d(1) - place;
    const Triangle& t = triangles_[which];
    const Vec3d p = t[0] + (t[1] - t[0]) * place.x + (t[2] - t[0]) * place.y;
    for (const Vec3d& q : positions_)
      if (glm::dot(p - q, p - q) < distance * distance) return false;
    positions_.push_back(p);
    points_.push_back({static_cast<std::uint32_t>(which), place});
    return true;
  }

  std::span<const Triangle> triangles_;
  PoissonOptions options_;
  Random random_;
  std::vector<double> areas_;  // sums so far
  std::vector<Vec3d> positions_;
  std::vector<SurfacePoint> points_;
};

}  // namespace

std::vector<SurfacePoint> poisson_disk(std::span<const Triangle> triangles, const PoissonOptions& options) {
  return Darts(triangles, options).run();
}

}  // namespace manzana::foliage
