#pragma once
/// Where a slab's picture is split, so that no pixel lies too far from its mosaic's plane.  [Zhang 2004, section 2.3]
#include <limits>

#include "foliage/ldm_pack.h"

namespace manzana::foliage {

/// By how many pixels a place `diff` m before or behind a plane seems moved on it, seen from `distance` m in the worst
/// direction: f diff / sqrt(d^2 - diff^2) [numerics 13.1]; equation 3 has f diff / d. Infinite from within.
inline double disparity(double diff, double distance, double focal_px) {
  if (diff == 0 && distance > 0) return 0;
  if (!(distance > diff)) return std::numeric_limits<double>::infinity();
  return focal_px * diff / std::sqrt((distance - diff) * (distance + diff));
}

/// A block of a slab's picture: where it is, and how much of each pixel nearer slabs hide.
struct LdmPlace {
  const LdmImage& image;
  int layer, column, row;
  const std::vector<float>& hidden;  ///< of each pixel of the layer: the share of its alpha
};

/// What a rectangle of pixels holds.
struct LdmStretch {
  int left = kLdmBlock, low = kLdmBlock, right = 0, high = 0;  ///< of what is visible; half-open, of the block
  double visible = 0;                                          ///< sum of alpha
  double hidden = 0;                                           ///< the share of that which is hidden
  double mean = 0, farthest = 0;  ///< depth in slabs, from the ball's front; the most that a pixel is off it
};
LdmStretch stretch_of(const LdmPlace& place, int left, int low, int side);

/// Mosaics of a block for a viewpoint so far away: split in four while the disparity is not under
/// (1 + s hidden) eta_d (equation 4) and parts are no smaller than `smallest`; empty parts are dropped, others cut to
/// what is visible. The mosaics' depth is in the ball's diameters; their block is 0.
std::vector<LdmMosaic> split_block(const LdmPlace& place, const LdmOptions& options, double radius, double distance);

}  // namespace manzana::foliage
