// The grid of directions: exact where a vertex is meant, and no jump on any path (numerics.md 10.2).
#include "foliage/octahedral.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kSides[]{2, 3, 4, 7, 8, 9, 16, 17};

Vec3d unit(double azimuth, double height) {
  return {std::cos(azimuth) * std::cos(height), std::sin(azimuth) * std::cos(height), std::sin(height)};
}

/// A random share of sight from each direction, one from both vertices of a pair.
std::vector<double> random_values(std::uint32_t side, std::uint64_t seed) {
  std::vector<double> values;
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i) {
      const Vec3d d = grid_direction(side, i, j);
      const auto whole = [](double v) { return static_cast<std::uint64_t>(std::llround(v * 1e6) + 2'000'000); };
      values.push_back(
          static_cast<double>(Random(hash(hash(hash(seed, whole(d.x)), whole(d.y)), whole(d.z))).uniform()));
    }
  return values;
}

double mixed(const std::vector<double>& values, const GridWeights& w) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += values[w.vertex[k]] * w.weight[k] / 256;
  return sum;
}

bool sound(std::uint32_t side, const GridWeights& w) {
  bool ok = w.weight[0] + w.weight[1] + w.weight[2] == 256;
  for (std::size_t k = 0; k < 3; ++k) ok = ok && w.weight[k] <= 256 && w.vertex[k] < side * side;
  return ok;
}

/// The weight of all vertices in direction d.
std::uint32_t weight_of(std::uint32_t side, const GridWeights& w, const Vec3d& d) {
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (glm::distance(grid_direction(side, w.vertex[k] % side, w.vertex[k] / side), d) < 1e-12) sum += w.weight[k];
  return sum;
}

}  // namespace

TEST_CASE("directions of the octahedral grid are unit vectors over the whole sphere") {
  for (const std::uint32_t side : kSides) {
    Vec3d low(1), high(-1);
    bool unit_length = true;
    for (std::uint32_t j = 0; j < side; ++j)
      for (std::uint32_t i = 0; i < side; ++i) {
        const Vec3d d = grid_direction(side, i, j);
        unit_length = unit_length && std::abs(glm::length(d) - 1) < 1e-15;
        low = glm::min(low, d), high = glm::max(high, d);
      }
    CHECK(unit_length);
    CHECK(low.z == -1);
    if (side % 2 == 1) CHECK(high == Vec3d(1));
  }
}

TEST_CASE("vertices of the octahedral rim come in pairs") {
  for (const std::uint32_t side : kSides)
    for (std::uint32_t i = 0; i < side; ++i) {
      CHECK(grid_direction(side, i, 0) == grid_direction(side, side - 1 - i, 0));
      CHECK(grid_direction(side, side - 1, i) == grid_direction(side, side - 1, side - 1 - i));
    }
}

TEST_CASE("a direction of the octahedral grid has its own value only") {
  for (const std::uint32_t side : kSides)
    for (std::uint32_t j = 0; j < side; ++j)
      for (std::uint32_t i = 0; i < side; ++i)
        for (const double length : {1.0, 1e-20, 37.5, 1e20}) {
          const Vec3d d = grid_direction(side, i, j);
          const GridWeights w = grid_weights(side, Vec3(d * length));
          REQUIRE(sound(side, w));
          CHECK(weight_of(side, w, d) == 256);
        }
}

TEST_CASE("half way between two octahedral neighbours each has half the weight") {
  constexpr std::uint32_t kSide = 9;
  for (std::uint32_t j = 0; j < kSide; ++j)
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      // Linear in a face of the octahedron: undo the normalisation before taking the middle.
      const auto flat = [](const Vec3d& d) { return d / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z)); };
      const Vec3d a = grid_direction(kSide, i, j), b = grid_direction(kSide, i + 1, j);
      const GridWeights w = grid_weights(kSide, Vec3(flat(a) + flat(b)));
      REQUIRE(sound(kSide, w));
      CHECK(weight_of(kSide, w, a) == 128);
      CHECK(weight_of(kSide, w, b) == 128);
      CHECK(sound(kSide, grid_weights(kSide, Vec3(-a))));
    }
}

TEST_CASE("what is no direction looks from above") {
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3& v : {Vec3(0), Vec3(kNan, 0, 1), Vec3(0, kInf, 0), Vec3(0, 0, -kInf), Vec3(3e38F), Vec3(1e-40F)}) {
    const GridWeights w = grid_weights(9, v);
    REQUIRE(sound(9, w));
    CHECK(weight_of(9, w, {0, 0, 1}) == 256);
  }
}

TEST_CASE("nothing jumps on an orbit over the octahedral grid") {
  constexpr double kLargestStep = 0.01;  // of 1, for 0.018 degrees
  constexpr int kSteps = 20'000;
  for (const std::uint32_t side : {5U, 8U, 9U, 17U}) {
    const std::vector<double> values = random_values(side, side);
    double largest = 0;
    bool all_sound = true;
    for (int orbit = 0; orbit < 40; ++orbit) {
      // Great circles, some of them through the poles and along the equator.
      Random random(hash(7, static_cast<std::uint64_t>(orbit)));
      const Vec3d a = orbit == 0   ? Vec3d(1, 0, 0)
                      : orbit == 1 ? Vec3d(0, 1, 0)
                                   : unit(6.3 * static_cast<double>(random.uniform()),
                                          3 * static_cast<double>(random.uniform()) - 1.5);
      const Vec3d other = orbit == 0 ? Vec3d(0, 1, 0) : orbit < 6 ? Vec3d(0, 0, 1) : unit(2.0 * orbit, 0.3);
      const Vec3d b = glm::normalize(other - a * glm::dot(a, other));
      double before = mixed(values, grid_weights(side, Vec3(a)));
      for (int step = 1; step <= kSteps; ++step) {
        const double t = 2 * 3.14159265358979 * step / kSteps;
        const GridWeights w = grid_weights(side, Vec3(a * std::cos(t) + b * std::sin(t)));
        const double now = mixed(values, w);
        all_sound = all_sound && sound(side, w);
        largest = std::max(largest, std::abs(now - before));
        before = now;
      }
    }
    CHECK(all_sound);
    CHECK(largest <= kLargestStep);
  }
}

TEST_CASE("octahedral weights are those of barycentric coordinates in double") {
  constexpr std::uint32_t kSide = 9;
  Random random(3);
  double worst = 0;
  for (int n = 0; n < 100'000; ++n) {
    const Vec3d d =
        unit(6.3 * static_cast<double>(random.uniform()), 3.1 * static_cast<double>(random.uniform()) - 1.55);
    const GridWeights w = grid_weights(kSide, Vec3(d));
    REQUIRE(sound(kSide, w));
    // The vertices' points on the octahedron, mixed by the weights, are the direction's point: cuts never cross a fold.
    Vec3d sum(0);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d v = grid_direction(kSide, w.vertex[k] % kSide, w.vertex[k] / kSide);
      sum += v / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z)) * (w.weight[k] / 256.0);
    }
    worst = std::max(worst, glm::distance(sum, d / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z))));
  }
  CHECK(worst <= 2.0 / 256 / (kSide - 1) * 1.5);  // half a 256th of a step each way, and its mirror below
}

}  // namespace manzana::foliage
