#include "foliage/far_pack.h"

#include "foliage/ldm_sampler.h"
#include "foliage/make_ldm.h"

namespace manzana::foliage {

/// These pictures have a quarter of the finest pixels a side: with 2 x 2 samples in each of those they have 64.
LdmPack make_far_pack(const PreparedPlant& plant) {
  constexpr int kFine = 2;
  LdmPack pack = make_ldm_pack(ldm_ball(plant), kFarPack, LdmSampler(plant, kFine));
  pack.height_m = plant.height_m;
  return pack;
}

}  // namespace manzana::foliage
