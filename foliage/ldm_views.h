#pragma once
/// Which sides of a pack are shown, and which of its levels, each by how much. All weights are in [0, 1] and sum to 1,
/// and change steadily as the eye moves.  [Zhang 2004, section 3]
#include <array>
#include <span>

#include "foliage/ldm_pack.h"

namespace manzana::foliage {

/// Unit vectors from the plant to where it is seen from.
std::vector<Vec3d> ldm_directions(LdmSides sides);

struct LdmWeights {
  std::array<std::uint32_t, 3> side{};
  std::array<float, 3> weight{1, 0, 0};
};

/// Of any length but 0, in the plant's frame. paper: f(cos alpha), f the Bezier curve through (0, 0) and (1, 1) with
/// control values 0, 0, 1, 1; of the three that have most, less what the fourth has, so that none comes or goes in a
/// step; divided by their sum. Where no angle is under 90 degrees: the nearest alone. octahedral:
/// barycentric, less 0.6 of the largest, divided by their sum.
LdmWeights ldm_weights(const LdmPack& pack, const Vec3& to_eye);
double adjusting_curve(double cos_alpha);

/// Levels `level` and `level + 1` at weights 1 - next and next.
struct LdmRing {
  int level = 0;
  float next = 0;
};

/// Where one level turns into the next: from `begin` to `end` m away. Throws std::invalid_argument when begin > end;
/// begin == end is a step.
struct LdmZone {
  LdmZone(double begin_m, double end_m);
  float next(double distance) const;  ///< equation 6
  double begin, end;
};

/// Of an eye at so many metres, of a plant of natural size. A level is shown from the distance that it is made for on.
LdmRing ldm_ring(const LdmPack& pack, double distance);

}  // namespace manzana::foliage
