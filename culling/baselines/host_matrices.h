#pragma once
/// The matrices that a host's own camera would have, by the textbook. For tests, and for the ways of culling that begin
/// with them.
#include "culling/host_camera.h"

namespace manzana::baselines {

/// projection * view takes L to clip space.
struct HostMatrices {
  Mat4d projection{1}, view{1};
  culling::ClipDepth depth = culling::ClipDepth::minus_one_to_one;
};

/// In double throughout, each entry as a host rounds it. Finite or infinite, off the axis or mirrored as the view is.
HostMatrices host_matrices(const culling::View& view, culling::ClipDepth depth);

/// The same camera and depths without an apex: what it shows is as large as the view's pyramid is at `distance`.
HostMatrices orthographic_matrices(const culling::View& view, double distance, culling::ClipDepth depth);

}  // namespace manzana::baselines
