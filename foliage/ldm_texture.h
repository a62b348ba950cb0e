#pragma once
/// How coarse a block of a slab's picture may be.  [Zhang 2004, section 2.2, after Kraus and Ertl 2002]
///   const auto pyramid = ldm_pyramid(block);
///   const int m = coarsest_level(pyramid, allowed_delta(hidden, options));
/// Averages keep coverage: a block's mean alpha is the same at each level.
#include <array>

#include "foliage/ldm_pack.h"

namespace manzana::foliage {

/// A square of texels, row by row.
struct LdmSquare {
  int side = 0;
  std::vector<LdmTexel> texels;
  LdmTexel& at(int x, int y) { return texels[static_cast<std::size_t>(y * side + x)]; }
  const LdmTexel& at(int x, int y) const { return texels[static_cast<std::size_t>(y * side + x)]; }
};

/// Octahedral, of a vector of any length but 0; and back to a unit vector.
std::array<std::uint8_t, 2> pack_ldm_normal(const Vec3& normal);
Vec3 unpack_ldm_normal(std::uint8_t x, std::uint8_t y);

/// What texels are together: colour in linear light, depth and normal by weight; leaf or bark by the most.
class LdmSum {
 public:
  void add(const LdmTexel& texel, float weight);
  float weight() const { return weight_; }
  LdmTexel mean(std::uint8_t alpha) const;  ///< of a weight that is not 0

 private:
  Vec3 colour_{0}, normal_{0};
  float weight_ = 0, depth_ = 0, leaf_ = 0, leaf_shade_ = 0, bark_shade_ = 0;
};

/// By alpha.
LdmTexel ldm_mean(const std::array<const LdmTexel*, 4>& parts);

/// So many pixels a side as one, so many layers as one: nearer ones before those behind. Both divide the image's.
LdmImage coarser(const LdmImage& image, int pixel, int merged);

/// Half as many texels a side.
LdmSquare halved(const LdmSquare& square);

/// The block, its half, ... 1 x 1. Empty texels have the colour of what is round them, so that filtering shows no
/// fringe; their alpha stays 0.
std::vector<LdmSquare> ldm_pyramid(LdmSquare block);

/// G(m, 0) of equation 1, of 255: the sum, over all of the block, of the differences of colours before black, of 3
/// channels their mean, by the sum of alpha. EXPAND repeats texels. 0 for an empty block.
double colour_difference(const std::vector<LdmSquare>& pyramid, int m);

/// m with G(m, 0) <= delta < G(m + 1, 0), going up from 0.
int coarsest_level(const std::vector<LdmSquare>& pyramid, double delta);

/// Equation 2. `hidden`: the share of what is visible of it alone that nearer slabs hide, in [0, 1].
inline double allowed_delta(double hidden, const LdmOptions& options) {
  return (1 + static_cast<double>(options.occlusion) * hidden) * static_cast<double>(options.colour_delta);
}

}  // namespace manzana::foliage
