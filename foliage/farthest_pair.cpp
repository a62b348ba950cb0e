#include "foliage/farthest_pair.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace manzana::foliage {
namespace {

constexpr std::size_t kMostEnds = 2000;  // for the exact way, which is quadratic

class Search {
 public:
  explicit Search(std::span<const Vec3> points) : points_(points) {}

  PointPair run() {
    sweep();
    const std::vector<std::uint32_t> ends = possible_ends();
    if (ends.size() > kMostEnds) return best_;
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = i + 1; j < ends.size(); ++j) offer(ends[i], ends[j]);
    return best_;
  }

 private:
  Vec3d at(std::uint32_t i) const { return Vec3d(points_[i]); }

  void offer(std::uint32_t i, std::uint32_t j) {
    const Vec3d d = at(i) - at(j);
    const double length2 = glm::dot(d, d);
    const PointPair pair{std::min(i, j), std::max(i, j)};
    if (std::tuple(-length2, pair.a, pair.b) < std::tuple(-length2_, best_.a, best_.b))
      length2_ = length2, best_ = pair;
  }

  std::uint32_t farthest_from(const Vec3d& p) const {
    std::uint32_t best = 0;
    double best2 = -1;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const Vec3d d = at(i) - p;
      if (const double d2 = glm::dot(d, d); d2 > best2) best = i, best2 = d2;
    }
    return best;
  }

  /// To and fro, from the first point and from the ends along the axes.
  void sweep() {
    for (const std::uint32_t start : {0U, lowest(0), lowest(1), lowest(2)}) {
      std::uint32_t from = start;
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t to = farthest_from(at(from));
        if (to != from) offer(from, to);
        from = to;
      }
    }
  }

  std::uint32_t lowest(int axis) const {
    const auto less = [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; };
    return static_cast<std::uint32_t>(std::min_element(points_.begin(), points_.end(), less) - points_.begin());
  }

  /// A point nearer to the middle than the length found, less the largest distance from the middle, is no end.
  std::vector<std::uint32_t> possible_ends() const {
    const Vec3d middle = 0.5 * (at(best_.a) + at(best_.b));
    const double most = glm::length(at(farthest_from(middle)) - middle);
    const double least = std::sqrt(length2_) * (1 - 1e-12) - most;
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = 0; i < points_.size() && ends.size() <= kMostEnds; ++i)
      if (glm::length(at(i) - middle) >= least) ends.push_back(i);
    return ends;
  }

  std::span<const Vec3> points_;
  PointPair best_{0, 1};
  double length2_ = 0;
};

}  // namespace

std::optional<PointPair> farthest_pair(std::span<const Vec3> points) {
  if (points.size() < 2) return std::nullopt;
  return Search(points).run();
}

}  // namespace manzana::foliage
