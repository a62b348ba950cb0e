#pragma once
/// What trees are shown as that are small in the picture: mosaics of their species' packs, and groves of blocks, as in
/// the walkthrough. There they are made in the background; here, before anything is measured.
///   FarSide far(plants, stage.sites());
///   use(far, {.mosaics = 32});                         // or as the walkthrough has it
///   do stage.draw_only(runs, shot, {.far = &far});
///   while (make_wanted(far));
#include <deque>

#include "foliage/grove.h"
#include "scenegraph/draw/far_trees.h"

namespace manzana::foliage_benchmark {

/// Where near trees give way to mosaics, and these to groves.
struct FarKnobs {
  double mosaics = draw::kAllMosaics;  ///< draw::TreesToSplit::all_mosaics
  foliage::GroveOptions groves;
  bool operator==(const FarKnobs&) const = default;
};

struct FarSide {
  /// With packs of all plants; groves follow. Plants and sites, block after block, must outlive it.
  FarSide(std::span<const foliage::PreparedPlant> all_plants, std::span<const foliage::TreeSite> all);

  std::span<const foliage::PreparedPlant> plants;
  std::span<const foliage::TreeSite> sites;
  FarKnobs knobs;
  draw::FarTrees trees;
  std::deque<draw::Groves> groves;        ///< of each knobs that were used
  draw::Groves* used;                     ///< of these
  std::uint64_t mosaics = 0, points = 0;  ///< drawn last
};

/// Triangles and points of the last picture.
inline std::uint64_t primitives_of(const FarSide& far) { return 2 * far.mosaics + far.points; }

void use(FarSide& far, const FarKnobs& knobs);

/// Groves that the last picture asked for. False: it has all that there is room for.
bool make_wanted(FarSide& far);

/// As draw::split_trees(), for one picture.
std::uint32_t split_trees(FarSide& far, draw::TreesToSplit trees, std::uint32_t* words);
void draw_far(FarSide& far, float focal_px, int samples);

}  // namespace manzana::foliage_benchmark
