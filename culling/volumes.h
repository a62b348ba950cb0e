#pragma once
/// Bounding volumes: values with public data. Every volume is a closed set; the default is empty, and empty() is asked
/// before any arithmetic, because no formula holds for an empty one [numerics: R5].
///   BoxD box; for (Vec3d p : points) box = merge(box, p);
///   Sphere small = narrow(sphere, origin);          // float, rounded outward: contains all that `sphere` contains
#include <limits>
#include <span>

#include "culling/vec.h"

namespace manzana::culling {

/// Closed ball, metres, float, relative to an origin that its owner names. Empty when radius < 0.
struct Sphere {
  Vec3 center{0, 0, 0};
  float radius = -std::numeric_limits<float>::infinity();
  bool empty() const { return radius < 0; }
};

/// Closed box along the axes, metres, float, relative to an origin that its owner names. Empty when min > max on an
/// axis.
struct Box {
  Vec3 min{std::numeric_limits<float>::infinity()}, max{-std::numeric_limits<float>::infinity()};
  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
};

/// The same in double, in the scene frame L.
struct SphereD {
  Vec3d center{0, 0, 0};
  double radius = -std::numeric_limits<double>::infinity();
  bool empty() const { return radius < 0; }
};
struct BoxD {
  Vec3d min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
};

BoxD merge(const BoxD& box, const Vec3d& point);
BoxD merge(const BoxD& a, const BoxD& b);
/// Of a box that is not empty; no overflow up to the largest double.
Vec3d center(const BoxD& box);

/// The smallest of the known enclosing balls of `spheres`, none of it trusted to rounding: the centre is that of the
/// box of the balls, the radius reaches round each of them and is then enlarged by more than its own error. Empty
/// members are passed over; no member, or only empty ones: empty. O(n).  [numerics 3]
SphereD enclosing_sphere(std::span<const SphereD> spheres);
/// The ball round a box's corners, outward. Empty for an empty box.
SphereD enclosing_sphere(const BoxD& box);

/// To float, relative to `origin`, rounded outward: contains every point of the argument.
Sphere narrow(const SphereD& sphere, const Vec3d& origin);
Box narrow(const BoxD& box, const Vec3d& origin);

}  // namespace manzana::culling
