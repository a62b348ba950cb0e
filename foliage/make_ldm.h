#pragma once
/// From a plant to its pack.
///   LdmTally tally;
///   const LdmPack pack = make_ldm_pack(ldm_ball(plant), {}, LdmSampler(plant), progress, &tally);  // ldm_sampler.h
#include <functional>

#include "foliage/ldm_pack.h"
#include "foliage/progress.h"

namespace manzana::foliage {

struct Ball {
  Vec3 centre{0};
  float radius = 1;
};
/// Of a plant's finest bark and its leaves, about the middle of their box.
Ball ldm_ball(const PreparedPlant& plant);

/// What a side's slabs show.
using SampleLdm = std::function<LdmImage(const ParallelView&, int layers)>;

/// Texels of all pictures, as table 1 counts them: raw; where each block is as coarse as may be, whatever is hidden (s
/// = 0, Kraus and Ertl 2002); and by equation 2.
struct LdmTally {
  double raw = 0, adaptive = 0, aware = 0;
  std::array<std::uint32_t, kLdmLevels> mosaics{};  ///< of all sides
};

/// Blocks on all cores. Throws std::invalid_argument for options out of range.
LdmPack make_ldm_pack(const Ball& ball, const LdmOptions& options, const SampleLdm& sample,
                      const Progress& progress = {}, LdmTally* tally = nullptr);

}  // namespace manzana::foliage
