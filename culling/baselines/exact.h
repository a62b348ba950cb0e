#pragma once
/// The exact answer to "does this box meet what the camera sees?": separating axes, in double where that is certain and
/// in fifty digits where it is not. For tests and benchmarks only; nothing that is installed links it.
///   ExactView exact = make_exact(view);
///   bool seen = exactly_overlaps(exact, box);
/// Two convex polyhedra are disjoint exactly when one of these directions separates them: a face normal of either, or
/// the cross product of an edge of each. It holds for the unbounded pyramid of an infinite view too.
/// [Gottschalk, Lin, Manocha: OBBTree (1996), section 5]
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "culling/frustum.h"
#include "culling/host_camera.h"
#include "culling/volumes.h"

namespace manzana::culling {

struct BigView;  // the same in fifty digits

/// What the camera sees, as a polyhedron relative to `eye`, metres; rounded to double.
struct ExactView {
  Vec3d eye;
  /// In the order of PlaneIndex; without a far plane five.
  std::vector<PlaneD> planes;
  /// Bits of the index: 1 right, 2 top, 4 far. Those of a far plane that is missing are corners shifted by 1 along the
  /// edge that leads there.
  std::array<Vec3d, 8> corners;
  /// Directions to test, of length 1, and the polyhedron's interval along each, which may be infinite; those of
  /// `planes` come first.
  struct Axis {
    Vec3d direction;
    double low, high;
  };
  std::vector<Axis> axes;
  std::shared_ptr<const BigView> exact;

  bool infinite() const { return planes.size() == 5; }
};

/// About 1 ms.
ExactView make_exact(const View& view);
/// What clip space keeps of exactly these matrices, products unrounded; the far plane too, unless its row has no
/// normal. Nothing else may be missing. The planes' own signs are trusted: of a matrix of float they may be wrong.
ExactView make_exact(const Mat4d& projection, const Mat4d& view, ClipDepth depth);

/// Closed sets. Right but for boxes that miss by less than 1e-38 m, which count as touching.
bool exactly_overlaps(const ExactView& view, const BoxD& box);
inline bool exactly_overlaps(const View& view, const BoxD& box) { return exactly_overlaps(make_exact(view), box); }

/// How far the box must be moved, at least, to leave the view, metres: along the axis that needs least. 0 when it is
/// not in it. In double.
double reach_into(const ExactView& view, const BoxD& box);

/// A flag a box.
std::vector<bool> exactly_visible(const View& view, std::span<const BoxD> boxes);

}  // namespace manzana::culling
