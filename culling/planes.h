#pragma once
/// A frustum made ready for one tree: what culling/lattice.h needs of each plane. A value; made once a query, 50 ns.
///   const Planes planes = make_planes(tree, make_frustum(view));
#include "culling/bqr_tree.h"
#include "culling/frustum.h"

namespace manzana::culling {

inline constexpr std::size_t kMaxPlanes = 8;  ///< places for planes, so that they fill registers

using Packet16 = std::array<std::uint16_t, kPacket>;

/// The planes whose bit is set in `used`; relative to the tree's origin. Letters as in culling/lattice.h.
struct alignas(64) Planes {
  std::array<double, kMaxPlanes> x{}, y{}, z{}, offset{};  ///< n, d
  std::array<double, kMaxPlanes> turned{};                 ///< N sum(max(-n_i, 0))
  std::array<double, kMaxPlanes> margin{};                 ///< m
  struct alignas(64) Column {
    std::array<Packet16, 3> a;                  ///< A_i in every lane, so that none has to be spread in the query
    std::array<std::uint16_t, 3> flip;          ///< all ones where n_i < 0: ~u instead of u
    std::array<std::uint16_t, 3> inner, outer;  ///< columns of a box: its reach inward, and outward
  };
  std::array<Column, kMaxPlanes> columns;  ///< filled where used
  unsigned used = 0;
};

/// A plane without a normal, or with anything not finite, is left out: it never culls. Normals are of length 1.
Planes make_planes(const BqrTree& tree, const FrustumD& frustum);

}  // namespace manzana::culling
