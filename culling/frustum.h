#pragma once
/// The camera, and the planes that bound what it sees.
///   View view = look(eye, forward, up, glm::radians(60.0), 16.0 / 9.0);   // reversed depth is the drawing's affair
///   FrustumD exact = make_frustum(view);                                  // double, relative to the eye
///   Frustum frustum = narrow(exact, tree.origin);                         // float, relative to the tree's origin
/// Planes come from the camera's parameters, not from the rows of a matrix: the far plane of a float matrix lies
/// kilometres off [numerics 1]. A host that has only matrices, or no apex, goes through culling/host_camera.h.
#include <array>
#include <cstdint>
#include <limits>

#include "culling/vec.h"

namespace manzana::culling {

/// A perspective camera. Eye in the scene frame L, metres; right, up, forward are orthonormal, in L; an image of a
/// mirror has right = -(forward x up). The sides of the pyramid are given by the tangents of their angles, so that
/// off-axis views are possible (left and bottom are negative as a rule). far may be infinite.
struct View {
  Vec3d eye{0, 0, 0};
  Vec3d right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};
  double tan_left = -1, tan_right = 1, tan_bottom = -1, tan_top = 1;
  double near_m = 0.1, far_m = std::numeric_limits<double>::infinity();
};

/// A symmetric view. `up` need not be orthogonal to `forward`, nor of unit length; when both are parallel another up is
/// taken. fovy is the full vertical angle in radians, aspect = width / height.
View look(const Vec3d& eye, const Vec3d& forward, const Vec3d& up, double fovy, double aspect, double near_m = 0.1,
          double far_m = std::numeric_limits<double>::infinity());

/// Half-space dot(normal, p) + offset >= 0; unit normal, to the kept side. Frame as its owner says.
struct PlaneD {
  Vec3d normal{0, 0, 0};
  double offset = 0;
};
struct Plane {
  Vec3 normal{0, 0, 0};
  float offset = 0;
};

/// Stands where a plane is missing: everything is inside it, nothing ever outside.
inline constexpr PlaneD kNoPlane{{0, 0, 0}, static_cast<double>(std::numeric_limits<float>::max())};

/// Order of the planes. An infinite view has no far plane: count is 5 then.
enum PlaneIndex : std::uint8_t { kLeft, kRight, kBottom, kTop, kNear, kFar };

/// Planes relative to the eye: p = position in L - eye. Exact to 4 units in the last place of the camera's parameters.
/// A side whose normal is not finite (a tangent that is not) becomes kNoPlane.
struct FrustumD {
  Vec3d eye{0, 0, 0};
  std::array<PlaneD, 6> planes{};
  int count = 0;
};
FrustumD make_frustum(const View& view);

/// Planes relative to an origin o: p = position in L - o. For the float tests of culling/overlap.h, whose margin covers
/// the rounding done here. `slack`, metres: the part of it that does not show in the float operands, because large
/// doubles cancelled in `offset`, or in the normal; some 1e-8 m, for shapes up to 1e7 m from the origin.
struct Frustum {
  std::array<Plane, 6> planes{};
  std::array<float, 6> slack{};
  int count = 0;
};
Frustum narrow(const FrustumD& frustum, const Vec3d& origin);

/// Radius in pixels of a ball seen from outside, exact; infinite for an eye inside it, so full detail. [numerics 2.7]
/// r = radius, d = distance of the centre, both in metres; f_px = image height / (tan_top - tan_bottom).
inline double projected_radius(double r, double d, double f_px) {
  return d > r ? f_px * r / glm::sqrt((d - r) * (d + r)) : std::numeric_limits<double>::infinity();
}

/// The same where there is no apex, in an orthographic view: at any distance. height_px: of the image; height_m: of
/// what it shows, metres.
inline double projected_radius_orthographic(double r, double height_px, double height_m) {
  return r * height_px / height_m;
}

}  // namespace manzana::culling
