#pragma once
/// A frustum made ready for one tree: what culling/lattice.h needs of each plane. A value; made once a query, 30 ns.
///   const Planes planes = make_planes(tree, make_frustum(view));
#include "culling/bqr_tree.h"
#include "culling/frustum.h"

namespace manzana::culling {

inline constexpr std::size_t kMaxPlanes = 8;  ///< places for planes, so that they fill registers

/// The planes whose bit is set in `used`; relative to the tree's origin. Letters as in culling/lattice.h.
struct alignas(64) Planes {
  std::array<double, kMaxPlanes> x{}, y{}, z{}, offset{};  ///< n, d
  std::array<double, kMaxPlanes> turned{};                 ///< N sum(max(-n_i, 0))
  std::array<double, kMaxPlanes> margin{};                 ///< m
  unsigned used = 0;
};

/// A plane without a normal, or with anything not finite, is left out: it never culls. Normals are of length 1.
Planes make_planes(const BqrTree& tree, const FrustumD& frustum);

}  // namespace manzana::culling
