#include "apps/foliage_benchmark/far_side.h"

#include <algorithm>

#include "apps/foliage_benchmark/stage.h"
#include "foliage/far_pack.h"

namespace manzana::foliage_benchmark {

FarSide::FarSide(std::span<const foliage::PreparedPlant> all_plants, std::span<const foliage::TreeSite> all)
    : plants(all_plants), sites(all), trees(plants.size(), shaders_with_mask()) {
  use(*this, {});
  for (std::uint32_t i = 0; i < plants.size(); ++i) add_pack(trees, i, make_far_pack(plants[i]));
}

void use(FarSide& far, const FarKnobs& knobs) {
  far.knobs = knobs;
  const auto known = std::ranges::find(far.groves, knobs.groves, &draw::Groves::options);
  far.used = known != far.groves.end()
                 ? &*known
                 : &far.groves.emplace_back(far.plants, far.sites, far.sites.empty() ? 0 : far.sites.back().block + 1,
                                            shaders_with_mask(), knobs.groves);
}

bool make_wanted(FarSide& far) {
  bool made = false;
  draw::Groves& groves = *far.used;
  for (const draw::GroveWanted& wanted : std::vector(groves.wanted))
    made = add_grove(groves, wanted, draw::make_grove(far.plants, far.sites, wanted, groves.options)) || made;
  return made;
}

std::uint32_t split_trees(FarSide& far, draw::TreesToSplit trees, std::uint32_t* words) {
  trees.all_mosaics = far.knobs.mosaics;
  trees.groves = far.used;
  begin_frame(*far.used);
  const std::uint32_t n = draw::split_trees(far.trees, trees, words);
  end_frame(*far.used);
  return n;
}

void draw_far(FarSide& far, float focal_px, int samples) {
  far.mosaics = draw_far_trees(far.trees, samples);
  far.points = draw_groves(*far.used, focal_px, samples);
}

}  // namespace manzana::foliage_benchmark
