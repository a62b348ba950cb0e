#pragma once
/// Points on the surface of what a camera sees, and shapes that just touch it. In double, so a touch is off by units of
/// the coordinates: what is really touched, exact.h says.
#include "culling/baselines/exact.h"
#include "culling/baselines/random.h"

namespace manzana::baselines {

/// Metres, relative to the eye. Every step along `away` leads straight away from the body.
struct Touch {
  Vec3d point, away;
};

/// `planes` 1: on a face, 2: on an edge, 3: at a corner; a random distance up to `reach` from the near face, about, or
/// on the far one.
Touch touch(const culling::ExactView& body, Random& random, int planes, double reach);

/// Within the body, `metres` from the near face, about, or at the far one; evenly spread across.
Vec3d point_inside(const culling::ExactView& body, Random& random, double metres);

/// Half of them evenly spread from 0 to `reach`, the others over the exponents from a millimetre.
double random_distance(Random& random, double reach);

/// A box of the given size, in L, one of whose corners is `depth` inside the body at the touch.
culling::BoxD box_on(const culling::ExactView& body, const Touch& touch, const Vec3d& size, double depth);

/// A box of the given size, in L, that reaches `depth` into the body along one of the separating axes: a corner or an
/// edge of the body against a face, an edge or a corner of the box.
culling::BoxD box_along_axis(const culling::ExactView& body, Random& random, const Vec3d& size, double depth,
                             double reach);

}  // namespace manzana::baselines
