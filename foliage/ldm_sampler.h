#pragma once
/// What a plant's slabs show from a side, drawn without GL: packs are made on any thread, beside whatever a host draws.
///   make_ldm_pack(ldm_ball(plant), {}, LdmSampler(plant));       // foliage/make_ldm.h
/// Pixels and textures are as a GPU has them: what is nearest at the middle of each, pictures filtered from their mip
/// levels. Slabs are drawn side by side where there are threads (TBB).
#include <vector>

#include "foliage/ldm_pack.h"
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

class LdmSampler {
 public:
  /// Each pixel of a picture is the mean of `fine` x `fine`, at most 8. The source has one ray a pixel. The plant must
  /// stay as it is.
  explicit LdmSampler(const PreparedPlant& plant, int fine = 4);
  /// A SampleLdm; some ten milliseconds for a plant of 20 000 triangles with `fine` 2.
  LdmImage operator()(const ParallelView& view, int layers) const;

 private:
  const PreparedPlant* plant_;
  int fine_;
  std::vector<Image> bark_, leaf_;  ///< mip levels
};

}  // namespace manzana::foliage
