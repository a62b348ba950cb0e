#include "culling/lattice.h"

#include <algorithm>
#include <cmath>

namespace manzana::culling {
namespace {

constexpr double kFinest = 0x1p-20;  // metres; a micrometre is finer than any survey

/// The smallest power of two that is not under x.
double power_of_two(double x) {
  int exponent = 0;
  const double m = std::frexp(x, &exponent);
  return std::ldexp(1, m == 0.5 ? exponent - 1 : exponent);
}

std::uint16_t to16(double x) { return static_cast<std::uint16_t>(std::clamp(x, 0.0, kLatticeEnd)); }

}  // namespace

Lattice make_lattice(const BoxD& box) {
  const Vec3d size = box.max - box.min;
  const Vec3d end = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double extent = std::max({size.x, size.y, size.z});
  const double farthest = std::max({end.x, end.y, end.z});
  // Two steps to spare, because the corner moves down to a multiple of the step; which, in steps, must fit into a
  // float.
  const double step = power_of_two(std::max({extent / (kLatticeEnd - 2), farthest * 0x1p-23, kFinest}));
  return {glm::floor(box.min / step) * step, step};
}

double reach_of(const Lattice& lattice) {
  return glm::length(glm::max(glm::abs(lattice.corner), glm::abs(lattice.far_corner())));
}

Reaches reaches_of(const BoxD& box, const Vec3d& low, const Vec3d& high, double steps_per_metre) {
  const Vec3d a = glm::ceil((box.max - low) * steps_per_metre), b = glm::ceil((high - box.min) * steps_per_metre);
  return {to16(a.x), to16(a.y), to16(a.z), to16(b.x), to16(b.y), to16(b.z)};
}

std::uint16_t lattice_radius(double radius, double step) {
  return to16(std::ceil((radius / step + 0.9) * (kTestScale / 65536)));
}

}  // namespace manzana::culling
