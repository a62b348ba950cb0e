#pragma once
/// Leaves in oriented cells. [Gumbau 2009, section 4; Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996]
///   for (const std::vector<std::uint32_t>& leaves : split_cells(source, 256)) ...
/// A set of leaves is cut across the longest side of its box, at the mean, until few enough quads are left.
#include <span>

#include "foliage/leaf_quads.h"

namespace manzana::foliage {

/// Closed, metres. Columns of axes: orthonormal but for rounding, det +1.
struct OrientedBox {
  Vec3 centre{0};
  Mat3 axes{1};
  Vec3 half{0};
};

/// Holds all points, each side padded by 8 units of the last place of the centre and a micrometre, so that flat sets
/// have volume. Its axes are the eigenvectors of the points' covariance (two passes, double), the longest spread first,
/// the larger part of the first two positive; the coordinate axes where these give the smaller box, or where no
/// direction is spread more than another. Throws std::invalid_argument for no point, and for one that is not finite or
/// farther than 1e9 m from the origin.
OrientedBox fit_box(std::span<const Vec3d> points);

double volume(const OrientedBox& box);

/// Rows of source.leaves, each in one set. A set has at most `most_quads` quads, or is one leaf. Deterministic; cost
/// n log n for a crown.
std::vector<std::vector<std::uint32_t>> split_cells(const LeafQuads& source, std::uint32_t most_quads);

}  // namespace manzana::foliage
