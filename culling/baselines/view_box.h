#pragma once
/// The box round what a camera sees, for structures that can be asked about boxes only.
#include "culling/frustum.h"
#include "culling/volumes.h"

namespace manzana::baselines {

/// In L, rounded outward. An infinite view is cut where `bounds` ends, and so is the box; with planes that are not
/// finite it is all of `bounds`. Empty where the view does not reach `bounds`.
culling::BoxD view_box(const culling::FrustumD& frustum, const culling::BoxD& bounds);

}  // namespace manzana::baselines
