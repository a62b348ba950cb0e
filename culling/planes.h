#pragma once
/// A frustum made ready for one tree: what culling/lattice.h needs of each plane. A value; made once a query, 30 ns.
///   const Planes planes = make_planes(tree, make_frustum(view));
#include "culling/bqr_tree.h"
#include "culling/frustum.h"

namespace manzana::culling {

inline constexpr std::size_t kMaxPlanes = 8;  ///< places for planes, so that they fill registers

/// The slope of a plane, as lanes are asked about it: a cache line.
struct alignas(64) Slope {
  std::array<std::array<std::uint16_t, 8>, 3> a;  ///< A_i, in all lanes of the smallest vectors
  std::array<std::uint16_t, 3> flip;              ///< all ones where n_i < 0: ~u instead of u
  std::array<std::uint8_t, 3> inner, outer;       ///< where a node's box has its reach inward, and outward
};

/// The planes whose bit is set in `used`, and nothing else; relative to the tree's origin. Letters as in
/// culling/lattice.h.
struct alignas(64) Planes {
  std::array<double, kMaxPlanes> x, y, z, offset;  ///< n, d
  std::array<double, kMaxPlanes> turned;           ///< N sum(max(-n_i, 0))
  std::array<double, kMaxPlanes> margin;           ///< m
  std::array<Slope, kMaxPlanes> slopes;
  unsigned used = 0;
};

/// A plane without a normal, or with anything not finite, is left out: it never culls. Normals are of length 1.
Planes make_planes(const BqrTree& tree, const FrustumD& frustum);

}  // namespace manzana::culling
