#pragma once
/// The frustum of a host that has a camera of its own, as matrices in double.
///   const HostFrustum seen = make_frustum(projection, view, ClipDepth::reversed);
///   const Frustum frustum = narrow(seen.frustum, tree.origin);
///   if (seen.far_plane == FarPlane::lost_in_float) ...   // nothing is culled for being far: hand over doubles
/// The projection may be a perspective or an orthographic one, finite or infinite, off the axis, skewed, mirrored, of
/// any scale. Column vectors: clip = projection * view * p with p in L; inside is what the graphics library keeps, so
/// the planes are sums of rows  [Gribb, Hartmann: Fast Extraction of Viewing Frustum Planes (2001)], of the projection
/// alone, and only then turned by the view: world-space rows would cancel. What is rounded, and by how much:
/// numerics 1.
#include "culling/frustum.h"

namespace manzana::culling {

/// Where clip space begins and ends in depth, for w = 1. The graphics library does not say it in its matrices.
enum class ClipDepth : std::uint8_t {
  minus_one_to_one,  ///< OpenGL as it starts
  zero_to_one,       ///< Vulkan, Direct3D, OpenGL after glClipControl
  reversed,          ///< the same with 1 near and 0 far
};

/// What became of the far plane.
enum class FarPlane : std::uint8_t {
  kept,           ///< moved outward by what double may have lost in the matrix: 8 u64 f^2 / n
  none,           ///< the projection has none, or none that double tells from infinity
  lost_in_float,  ///< all sixteen entries of the projection are floats: its far plane may lie kilometres off, so it is
                  ///< left out. A projection that is short by chance is taken for one: more is drawn, nothing is lost.
};

/// frustum.eye is the origin of view space, also where there is no apex (orthographic). A plane whose normal is zero or
/// not finite is kNoPlane. So matrices that are no camera at all cull nothing.
struct HostFrustum {
  FrustumD frustum;
  FarPlane far_plane = FarPlane::none;
};

/// Of exactly these matrices: planes to 4 units in the last place (the far plane moved outward besides), at any place;
/// what a float matrix lost before it came here stays lost, but for its far plane. view: affine (last row 0 0 0 1), any
/// scale, mirrored or sheared too. Hand over both: in their product, with Mat4d(1) as view, world coordinates have been
/// rounded, and nothing here can tell how far the planes have moved.
HostFrustum make_frustum(const Mat4d& projection, const Mat4d& view, ClipDepth depth);

}  // namespace manzana::culling
