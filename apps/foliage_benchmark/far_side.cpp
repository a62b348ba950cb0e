#include "apps/foliage_benchmark/far_side.h"

#include "apps/foliage_benchmark/stage.h"
#include "foliage/far_pack.h"

namespace manzana::foliage_benchmark {

FarSide::FarSide(std::span<const foliage::PreparedPlant> all_plants, std::span<const foliage::TreeSite> all)
    : plants(all_plants),
      sites(all),
      trees(plants.size(), shaders_with_mask()),
      groves(plants, all, all.empty() ? 0 : all.back().block + 1, shaders_with_mask()) {
  for (std::uint32_t i = 0; i < plants.size(); ++i) add_pack(trees, i, make_far_pack(plants[i]));
}

bool make_wanted(FarSide& far) {
  bool made = false;
  for (const draw::GroveWanted& wanted : std::vector(far.groves.wanted))
    made = add_grove(far.groves, wanted, draw::make_grove(far.plants, far.sites, wanted)) || made;
  return made;
}

std::uint32_t split_trees(FarSide& far, draw::TreesToSplit trees, std::uint32_t* words) {
  trees.groves = &far.groves;
  begin_frame(far.groves);
  const std::uint32_t n = draw::split_trees(far.trees, trees, words);
  end_frame(far.groves);
  return n;
}

void draw_far(FarSide& far, float focal_px, int samples) {
  far.mosaics = draw_far_trees(far.trees, samples);
  far.points = draw_groves(far.groves, focal_px, samples);
}

}  // namespace manzana::foliage_benchmark
