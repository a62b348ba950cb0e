#pragma once
/// What a camera sees as an intersection of slabs, the layers between two parallel planes, in a precision to choose.
///   const auto faces = face_slabs<float>(frustum, origin);          // a slab a plane of the frustum
///   if (apart(faces, box)) ...                                      // certainly outside, whatever the rounding
/// A shape is apart from the camera's body if it is apart from some slab along its direction. With the frustum's own
/// planes that says too little for some boxes; with the other separating axes it is exact for boxes.
#include <limits>
#include <vector>

#include "culling/frustum.h"

namespace manzana::culling_benchmark {

template <class Real>
using Vec = glm::vec<3, Real>;

/// The points p with low <= dot(direction, p) <= high; either end may be infinite. Metres, relative to an origin.
template <class Real>
struct Slab {
  Vec<Real> direction, size;  ///< unit, and the absolute values of its components
  Real low, high;
  Real margin;  ///< what the rounding of these ends may amount to
};

struct SlabD {
  Vec3d direction;
  double low, high;  ///< relative to the eye
};
/// One for each of the frustum's planes.
std::vector<SlabD> face_slabs(const culling::FrustumD& frustum);
/// These, and those of all other axes that can separate a box from the camera's body.
std::vector<SlabD> all_slabs(const culling::FrustumD& frustum);

/// Rounded once for each coefficient, coordinate, product and sum; in double the planes themselves carry some more.
template <class Real>
constexpr Real kSlabUnits = Real(sizeof(Real) == sizeof(float) ? 16 : 256) * std::numeric_limits<Real>::epsilon() / 2;

/// Moved from the eye to `origin`.
template <class Real>
std::vector<Slab<Real>> narrow_slabs(const std::vector<SlabD>& slabs, const Vec3d& eye, const Vec3d& origin) {
  std::vector<Slab<Real>> narrowed;
  for (const SlabD& s : slabs) {
    const double shift = glm::dot(s.direction, eye - origin);
    const double size = glm::dot(glm::abs(s.direction), glm::abs(eye - origin));  // of what cancels in the shift
    const auto finite = [](double end) { return glm::abs(end) < 1e300 ? glm::abs(end) : 0; };
    const double ends = finite(s.low) + finite(s.high) + size;
    narrowed.push_back({Vec<Real>(s.direction), Vec<Real>(glm::abs(s.direction)), static_cast<Real>(s.low + shift),
                        static_cast<Real>(s.high + shift), kSlabUnits<Real> * static_cast<Real>(ends)});
  }
  return narrowed;
}

template <class Real>
struct Ball {
  Vec<Real> center;
  Real radius;
};
template <class Real>
struct Brick {
  Vec<Real> min, max;
};

template <class Real>
bool apart(const Slab<Real>& slab, const Ball<Real>& ball) {
  const Vec<Real> terms = slab.direction * ball.center;
  const Real at = terms.x + terms.y + terms.z;
  const Real margin = kSlabUnits<Real> * (glm::dot(slab.size, glm::abs(ball.center)) + ball.radius) + slab.margin;
  return at + ball.radius < slab.low - margin || at - ball.radius > slab.high + margin;
}

template <class Real>
bool apart(const Slab<Real>& slab, const Brick<Real>& brick) {
  const Vec<Real> a = slab.direction * brick.min, b = slab.direction * brick.max;
  const Vec<Real> least = glm::min(a, b), most = glm::max(a, b);
  const Real margin =
      kSlabUnits<Real> * glm::dot(slab.size, glm::max(glm::abs(brick.min), glm::abs(brick.max))) + slab.margin;
  return most.x + most.y + most.z < slab.low - margin || least.x + least.y + least.z > slab.high + margin;
}

template <class Real, class Shape>
bool apart(const std::vector<Slab<Real>>& slabs, const Shape& shape) {
  for (const Slab<Real>& slab : slabs)
    if (apart(slab, shape)) return true;
  return false;
}

}  // namespace manzana::culling_benchmark
