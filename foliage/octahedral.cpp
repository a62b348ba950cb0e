#include "foliage/octahedral.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

// Places on the grid are whole 256ths of a step, counted from the middle. All that decides is a comparison of floats
// that any IEEE machine rounds alike, so a shader whose variables are `precise` gives the same integers.

/// Too short to count: a GPU may flush what is smaller on the way.
float flushed(float v) { return std::abs(v) < 0x1p-100F ? 0 : v; }

/// The largest whole q with q s <= half a 256th more than steps a: steps a / s, to the nearest. The quotient only
/// guesses: it may be one off on a GPU. 0 <= a <= s.
std::int32_t rounded_share(float a, float s, std::int32_t steps) {
  const float limit = static_cast<float>(steps) * a + 0.5F * s;
  auto q = static_cast<std::int32_t>(limit / s);
  if (static_cast<float>(q) * s > limit) --q;
  if (static_cast<float>(q + 1) * s <= limit) ++q;
  return std::min(q, steps);
}

/// The corners of a step's square, each of which is two triangles.
struct Square {
  std::uint32_t side, i, j;  ///< of the lowest corner
  std::uint32_t at(std::uint32_t x, std::uint32_t y) const { return (j + y) * side + i + x; }
};

/// Cut from (0, 0) to (1, 1); f and g are the place in the square.
GridWeights rising_cut(const Square& s, std::uint32_t f, std::uint32_t g) {
  if (f >= g) return {{s.at(0, 0), s.at(1, 0), s.at(1, 1)}, {256 - f, f - g, g}};
  return {{s.at(0, 0), s.at(0, 1), s.at(1, 1)}, {256 - g, g - f, f}};
}

/// Cut from (1, 0) to (0, 1).
GridWeights falling_cut(const Square& s, std::uint32_t f, std::uint32_t g) {
  if (f + g <= 256) return {{s.at(0, 0), s.at(1, 0), s.at(0, 1)}, {256 - f - g, f, g}};
  return {{s.at(1, 1), s.at(1, 0), s.at(0, 1)}, {f + g - 256, 256 - g, 256 - f}};
}

/// x and y in 256ths from the middle, at most `half` either way. Cuts run along the equator.
GridWeights weights_at(std::uint32_t side, std::int32_t half, std::int32_t x, std::int32_t y) {
  const auto from_edge_x = static_cast<std::uint32_t>(half + x), from_edge_y = static_cast<std::uint32_t>(half + y);
  const Square s{side, std::min(from_edge_x / 256, side - 2), std::min(from_edge_y / 256, side - 2)};
  const std::uint32_t f = from_edge_x - 256 * s.i, g = from_edge_y - 256 * s.j;
  const bool right = 2 * s.i + 1 >= side - 1, up = 2 * s.j + 1 >= side - 1;
  return right == up ? falling_cut(s, f, g) : rising_cut(s, f, g);
}

}  // namespace

Vec3d grid_direction(std::uint32_t side, std::uint32_t i, std::uint32_t j) {
  const auto place = [&](std::uint32_t k) {
    return (2.0 * static_cast<double>(k) - static_cast<double>(side - 1)) / static_cast<double>(side - 1);
  };
  const double u = place(i), v = place(j), z = 1 - std::abs(u) - std::abs(v);
  if (z >= 0) return glm::normalize(Vec3d(u, v, z));
  return glm::normalize(Vec3d(std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v), z));
}

GridWeights grid_weights(std::uint32_t side, const Vec3& direction) {
  const auto half = static_cast<std::int32_t>((side - 1) * 128);
  const float x = flushed(direction.x), y = flushed(direction.y), z = flushed(direction.z);
  const float sum = (std::abs(x) + std::abs(y)) + std::abs(z);
  if (!(sum > 0) || !(sum < 0x1p100F)) return weights_at(side, half, 0, 0);
  std::int32_t a = rounded_share(std::abs(x), sum, half), b = rounded_share(std::abs(y), sum, half);
  if (z < 0) {
    const std::int32_t folded = half - b;
    b = half - a;
    a = folded;
  }
  return weights_at(side, half, x < 0 ? -a : a, y < 0 ? -b : b);
}

}  // namespace manzana::foliage
