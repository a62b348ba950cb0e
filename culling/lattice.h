#pragma once
/// Volumes as 16-bit distances, and the arithmetic by which planes are asked about them.
/// A lattice is a corner c and a step h, a power of two, both exact; its far corner is c + N h, N = 65535. Along an
/// axis a coordinate is u steps from the corner, or N - u = ~u steps from the far one. A plane (unit normal n, offset
/// d) is asked from the corner of the lattice that lies farthest on its outer side, whose coordinate is n_i >= 0 ? c_i
/// : c_i + N h. There its distance is D = d + n.c - h N sum(max(-n_i, 0)), and a point w steps from there has
///   s = D + h sum(|n_i| w_i).
/// All is compared in units of 1/k, k = S / (65536 h), S = 37800, because then it fits into 16 bits:
///   A_i = floor(S |n_i|) + 1,  F = sum(floor(A_i w_i / 65536)):  |F - k h sum(|n_i| w_i)| < 3,
/// three floors take less than 3, the ceilings in A add less than 3; F < 65536, because sum |n_i| <= sqrt 3.
/// With m, more than the error of D in double:
///   outside, s < -m for certain,  if F < t_out = floor(k (-D - m)) - 2
///   inside,  s > m for certain,   if F >= t_in = ceil(k (m - D)) + 3
/// A ball has R = ceil(k (r + 0.9 h)) (its centre is rounded to the lattice, which moves it by sqrt 3 / 2 h at
/// most): outside if F + R < t_out, inside if F >= t_in + R. A box keeps its reaches a_i = max_i - c_i and b_i = c_i +
/// N h - min_i, rounded up: its corner farthest inward has w_i = n_i >= 0 ? a_i : b_i, the one farthest outward w_i =
/// ~(n_i >= 0 ? b_i : a_i). Objects have reaches from the corners of their block's box, on steps of h / 2^shift. Seen
/// from the block's outer corner, with F' there, k D' < k D + F' + 3, so k (-D' - m) > t_out - F' - 1, and t_out of the
/// finer lattice is 2^shift (t_out - F' - 1) - 2. Whatever is clamped to 16 bits is clamped towards keeping, as long as
/// boxes and the centres of balls are within the lattice. What doubles round before they are rounded outward here is
/// part of m.
#include <array>
#include <cmath>
#include <cstdint>

#include "culling/volumes.h"

namespace manzana::culling {

inline constexpr double kLatticeEnd = 65535;  ///< N
inline constexpr double kTestScale = 37800;   ///< S

struct Lattice {
  Vec3d corner{0, 0, 0};
  double step = 1;
  Vec3d far_corner() const { return corner + kLatticeEnd * step; }
};

/// A_i.
inline std::uint16_t lattice_factor(double n) {
  return static_cast<std::uint16_t>(static_cast<int>(kTestScale * std::abs(n)) + 1);
}

/// No point between its corners is farther from the origin.
double reach_of(const Lattice& lattice);

/// The finest lattice round a box that is not empty; its corner is exact in float too.
Lattice make_lattice(const BoxD& box);

/// max x, y, z from `low`, then min x, y, z from `high`, in steps, rounded up; clamped to [0, N].
using Reaches = std::array<std::uint16_t, 6>;
Reaches reaches_of(const BoxD& box, const Vec3d& low, const Vec3d& high, double steps_per_metre);

/// R. Clamped to N, which is never outside and never inside.
std::uint16_t lattice_radius(double radius, double step);

}  // namespace manzana::culling
