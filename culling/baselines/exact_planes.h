#pragma once
/// The planes of a camera in fifty digits: what culling/frustum.h and culling/host_camera.h are measured against, and
/// where the exact answer begins.
#include <array>

#include "culling/baselines/big.h"
#include "culling/frustum.h"
#include "culling/host_camera.h"

namespace manzana::culling {

/// In the order of PlaneIndex, of length 1; a plane that is missing has a zero normal.
using BigPlanes = std::array<BigPlane, 6>;

/// Relative to the eye, of exactly these parameters.
BigPlanes exact_planes(const View& view);
/// Of exactly these matrices, relative to `eye`.
BigPlanes exact_planes(const Mat4d& projection, const Mat4d& view, ClipDepth depth, const Vec3d& eye);

inline bool missing(const BigPlane& plane) { return plane.normal.x == 0 && plane.normal.y == 0 && plane.normal.z == 0; }

}  // namespace manzana::culling
