#pragma once
/// A pack covers as much as its plant, from between its sides too: how much mosaics grow as they turn to the eye is
/// fitted, for each level.
///   fit_grown(pack, seen);
#include <span>

#include "foliage/ldm_pack.h"

namespace manzana::foliage {

/// What a plant covers of the square round its ball.
struct LdmSeenFrom {
  Vec3d to_eye;  ///< unit
  double cover;
};

/// Evenly spread directions that plants are seen from: a little from below, rarely from straight above.
std::vector<Vec3d> ldm_fitting_directions();

/// What a level of one side covers, turned to the eye, in a picture of so many pixels a side, drawn as the GPU does it.
/// `alphas`: of the same pack.
class LdmAlphas;
double ldm_cover(const LdmPack& pack, const LdmAlphas& alphas, std::uint32_t side, int level, const Vec3d& to_eye,
                 float grown, int pixels);

/// Alpha of pages and of their mip levels, in [0, 1].
class LdmAlphas {
 public:
  explicit LdmAlphas(const LdmPack& pack);
  /// In texels of the finest level: filtered as foliage/shaders/ldm.glsl does, within the block's square.
  float at(const LdmBlock& block, float x, float y, int level) const;

 private:
  std::vector<std::vector<float>> levels_;
};

/// Sets LdmPack::grown. Nothing where mosaics do not turn.
void fit_grown(LdmPack& pack, std::span<const LdmSeenFrom> seen);

}  // namespace manzana::foliage
