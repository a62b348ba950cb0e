#include "foliage/obb_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace manzana::foliage {
namespace {

void require_sound(std::span<const Vec3d> points) {
  constexpr double kFarthest = 1e9;
  if (points.empty()) throw std::invalid_argument("a box of no points");
  for (const Vec3d& p : points)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(p[k]) <= kFarthest)) throw std::invalid_argument("a leaf's corner is not finite, or too far away");
}

Vec3d mean(std::span<const Vec3d> points) {
  Vec3d sum(0);
  for (const Vec3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Around their mean: E[xx] - E[x]^2 loses all digits far from the origin (numerics.md 14).
Mat3d covariance(std::span<const Vec3d> points) {
  const Vec3d middle = mean(points);
  Mat3d sum(0);
  for (const Vec3d& p : points) sum += glm::outerProduct(p - middle, p - middle);
  return sum / static_cast<double>(points.size());
}

/// One of Jacobi's rotations: makes m[q][p] zero, and turns v's columns with it.  [Golub and Van Loan, 8.5]
void rotate(Mat3d& m, Mat3d& v, int p, int q) {
  if (m[q][p] == 0) return;
  const double tau = (m[q][q] - m[p][p]) / (2 * m[q][p]);
  const double t = std::copysign(1 / (std::abs(tau) + std::sqrt(1 + tau * tau)), tau);
  const double c = 1 / std::sqrt(1 + t * t), s = t * c;
  Mat3d turn(1);
  turn[p][p] = turn[q][q] = c;
  turn[q][p] = s;
  turn[p][q] = -s;
  m = glm::transpose(turn) * m * turn;
  m[q][p] = m[p][q] = 0;
  v = v * turn;
}

struct Eigen {
  Vec3d values;
  Mat3d vectors;  // columns, orthonormal
};

/// Of a symmetric matrix; the rotations keep the columns orthonormal whatever the matrix, ties and zeros too.
Eigen eigen(Mat3d m) {
  constexpr int kSweeps = 12;  // it converges quadratically; six are enough for any 3 x 3
  Mat3d v(1);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    rotate(m, v, 0, 1);
    rotate(m, v, 0, 2);
    rotate(m, v, 1, 2);
  }
  return {glm::max(Vec3d(m[0][0], m[1][1], m[2][2]), 0.0), v};
}

Vec3d with_larger_part_positive(const Vec3d& v) {
  int largest = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(v[k]) > std::abs(v[largest])) largest = k;
  return v[largest] < 0 ? -v : v;
}

/// Longest spread first; signs fixed; right-handed. The coordinate axes where all spreads are alike.
Mat3d principal_axes(std::span<const Vec3d> points) {
  const Eigen e = eigen(covariance(points));
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return e.values[a] > e.values[b]; });
  if (e.values[order[0]] - e.values[order[2]] <= 1e-3 * e.values[order[0]]) return Mat3d(1);
  const Vec3d first = with_larger_part_positive(glm::normalize(e.vectors[order[0]]));
  const Vec3d second = with_larger_part_positive(glm::normalize(e.vectors[order[1]]));
  return {first, second, glm::cross(first, second)};
}

float rounded_up(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// In floats, and around the points as these floats stand.
OrientedBox box_along(const Mat3d& axes, std::span<const Vec3d> points) {
  OrientedBox box{.axes = Mat3(axes)};
  const Mat3d rows = glm::transpose(Mat3d(box.axes));
  const Vec3d base = mean(points);
  Vec3d low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  for (const Vec3d& p : points) low = glm::min(low, rows * (p - base)), high = glm::max(high, rows * (p - base));
  box.centre = Vec3(base + Mat3d(box.axes) * (0.5 * (low + high)));
  Vec3d reach(0);
  for (const Vec3d& p : points) reach = glm::max(reach, glm::abs(rows * (p - Vec3d(box.centre))));
  const double pad = 8 * 0x1p-24 * glm::length(Vec3d(box.centre)) + 1e-6;
  for (int k = 0; k < 3; ++k) box.half[k] = rounded_up(reach[k] + pad);
  return box;
}

/// A set of leaves, and the corners of all its quads.
class Splitter {
 public:
  Splitter(const LeafQuads& source, std::uint32_t most_quads) : source_(source), most_quads_(most_quads) {
    for (const Run& leaf : source.leaves) middles_.push_back(mean(corners_of(std::span(&leaf, 1))));
  }

  std::vector<std::vector<std::uint32_t>> run() {
    std::vector<std::uint32_t> all(source_.leaves.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    std::vector<std::vector<std::uint32_t>> todo, done;
    if (!all.empty()) todo.push_back(std::move(all));
    while (!todo.empty()) {
      std::vector<std::uint32_t> set = std::move(todo.back());
      todo.pop_back();
      if (set.size() == 1 || quads(set) <= most_quads_) {
        done.push_back(std::move(set));
        continue;
      }
      const auto [low, high] = halves(set);
      todo.emplace_back(high);
      todo.emplace_back(low);
    }
    return done;
  }

 private:
  using Halves = std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>;

  std::vector<Vec3d> corners_of(std::span<const Run> leaves) const {
    std::vector<Vec3d> corners;
    for (const Run& leaf : leaves)
      for (std::uint32_t q = leaf.first; q < leaf.last; ++q)
        for (const PlantQuad::Corner& corner : source_.quads[q].corners) corners.emplace_back(corner.position);
    return corners;
  }

  std::size_t quads(const std::vector<std::uint32_t>& set) const {
    std::size_t sum = 0;
    for (const std::uint32_t leaf : set) sum += source_.leaves[leaf].size();
    return sum;
  }

  /// Across the longest axis on which the middles differ; where they are all one, by their order.
  Halves halves(const std::vector<std::uint32_t>& set) const {
    std::vector<Run> runs;
    for (const std::uint32_t leaf : set) runs.push_back(source_.leaves[leaf]);
    const OrientedBox box = fit_box(corners_of(runs));
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return box.half[a] > box.half[b]; });
    for (const int axis : order) {
      Halves cut = cut_at_mean(set, Vec3d(box.axes[axis]));
      if (!cut.first.empty() && !cut.second.empty()) return cut;
    }
    const auto half = set.begin() + static_cast<std::ptrdiff_t>(set.size() / 2);
    return {{set.begin(), half}, {half, set.end()}};
  }

  Halves cut_at_mean(const std::vector<std::uint32_t>& set, const Vec3d& axis) const {
    double sum = 0;
    for (const std::uint32_t leaf : set) sum += glm::dot(middles_[leaf], axis);
    Halves cut;
    for (const std::uint32_t leaf : set)
      (glm::dot(middles_[leaf], axis) * static_cast<double>(set.size()) < sum ? cut.first : cut.second).push_back(leaf);
    return cut;
  }

  const LeafQuads& source_;
  std::uint32_t most_quads_;
  std::vector<Vec3d> middles_;
};

}  // namespace

OrientedBox fit_box(std::span<const Vec3d> points) {
  require_sound(points);
  const OrientedBox straight = box_along(Mat3d(1), points), turned = box_along(principal_axes(points), points);
  return volume(turned) < volume(straight) ? turned : straight;
}

double volume(const OrientedBox& box) {
  const Vec3d side = 2.0 * Vec3d(box.half);
  return side.x * side.y * side.z;
}

std::vector<std::vector<std::uint32_t>> split_cells(const LeafQuads& source, std::uint32_t most_quads) {
  return Splitter(source, most_quads).run();
}

}  // namespace manzana::foliage
