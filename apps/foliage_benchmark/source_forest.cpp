#include "apps/foliage_benchmark/source_forest.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "apps/foliage_benchmark/stand_in.h"
#include "foliage/prepare.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::PreparedPlant;

constexpr std::array<SourceTree, 7> kTrees{{{"broadleaf", 32214},
                                            {"lime", 57290},
                                            {"oak", 82310},
                                            {"conifer", 262084},
                                            {"birch", 19076},
                                            {"poplar", 60059},
                                            {"pine", 430836}}};

constexpr double kSpacingsOfBlock = 7;  // 49 trees: the import of a city has 16 to 64

}  // namespace

std::span<const SourceTree> source_trees() { return kTrees; }

std::vector<PreparedPlant> prepare_source_trees(std::uint32_t visibility_side) {
  std::vector<PreparedPlant> plants(kTrees.size());
  tbb::parallel_for(std::size_t{0}, plants.size(), [&](std::size_t i) {
    plants[i] = prepare(grown_dense(kTrees[i].species, kTrees[i].triangles), {.visibility_side = visibility_side});
    plants[i].name = kTrees[i].species;
  });
  return plants;
}

Forest::Forest(std::vector<PreparedPlant> species, std::uint32_t trees, double most_full_quads)
    : plants(std::move(species)),
      half_m(closed_spacing(plants) * std::sqrt(trees) / 2),
      ground(
          plants,
          in_blocks(make_forest(plants, trees, closed_spacing(plants), 3), kSpacingsOfBlock * closed_spacing(plants)),
          most_full_quads) {}

std::vector<Shot> Forest::path(int frames, int height_px) const {
  return forest_path(half_m, frames, height_px, static_cast<double>(plants.front().height_m));
}

}  // namespace manzana::foliage_benchmark
