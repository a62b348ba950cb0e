#pragma once
/// The exact answer to "does this box meet what the camera sees?", slow and sure: separating axes in long double. For
/// tests and benchmarks only; nothing that is installed links it.
///   ExactView exact = make_exact(view);
///   bool seen = exactly_overlaps(exact, box);
/// Two convex polyhedra are disjoint exactly when one of these directions separates them: a face normal of either, or
/// the cross product of an edge of each. It holds for the unbounded pyramid of an infinite view too.
/// [Gottschalk, Lin, Manocha: OBBTree (1996), section 5]
#include <array>
#include <span>
#include <vector>

#include "culling/frustum.h"
#include "culling/volumes.h"

namespace manzana::culling {

using Vec3l = glm::vec<3, long double>;

/// What the camera sees, as a polyhedron relative to the eye: the hull of `corners` and, for an infinite view, of all
/// rays from them along `rays`. Metres.
struct ExactView {
  Vec3l eye;
  std::vector<Vec3l> corners, rays;
  struct Axis {
    Vec3l direction;
    long double low, high;  ///< the polyhedron's interval along it; may be infinite
  };
  std::vector<Axis> axes;
};
ExactView make_exact(const View& view);

/// Closed sets. Rounding: 1e-18 of the largest coordinate relative to the eye.
bool exactly_overlaps(const ExactView& view, const BoxD& box);
inline bool exactly_overlaps(const View& view, const BoxD& box) { return exactly_overlaps(make_exact(view), box); }

/// A flag a box.
std::vector<bool> exactly_visible(const View& view, std::span<const BoxD> boxes);

}  // namespace manzana::culling
