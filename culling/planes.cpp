#include "culling/planes.h"

#include <cassert>
#include <cmath>

#include "culling/lattice.h"

namespace manzana::culling {
namespace {

constexpr double kUnit = 0x1p-53;

bool usable(const PlaneD& p) {
  const double size = std::abs(p.normal.x) + std::abs(p.normal.y) + std::abs(p.normal.z);
  return size > 0 && std::isfinite(size + p.offset);
}

}  // namespace

Planes make_planes(const BqrTree& tree, const FrustumD& frustum) {
  Planes planes;
  const Vec3d shift = tree.origin - frustum.eye;
  // Normals are exact to 4 units, so a plane is off by 4 units of its distance from the eye; volumes and what is
  // computed here and for each node round some ten times more, by a unit of what is farthest.
  const double farthest = glm::length(shift) + 2 * tree.reach;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const PlaneD& p = frustum.planes[k];
    if (!usable(p)) continue;
    assert(std::abs(glm::length(p.normal) - 1) < 1e-6);  // longer ones would not fit into 16 bits
    planes.used |= 1U << k;
    planes.x[k] = p.normal.x;
    planes.y[k] = p.normal.y;
    planes.z[k] = p.normal.z;
    planes.offset[k] = glm::dot(p.normal, shift) + p.offset;
    planes.turned[k] =
        kLatticeEnd * (std::max(-p.normal.x, 0.0) + std::max(-p.normal.y, 0.0) + std::max(-p.normal.z, 0.0));
    planes.margin[k] = 64 * kUnit * (farthest + std::abs(p.offset));
  }
  return planes;
}

}  // namespace manzana::culling
