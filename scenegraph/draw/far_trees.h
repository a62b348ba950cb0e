#pragma once
/// Trees that are small in the picture, as mosaics of their species' packs (foliage/ldm_pack.h).
///   split_trees(far, seen, words);     // each frame: which are near, which far, how much of those in between
///   draw_far_trees(far, samples);
/// Where one way gives way to the other each sample of a pixel shows one of them, so nothing is drawn twice and a crown
/// covers as much.
#include <deque>
#include <memory>

#include "foliage/gl/draw_ldm.h"
#include "scenegraph/draw/groves.h"

namespace manzana::draw {

/// Heights in tolerated errors (pixels, where one may be wrong): lower trees are mosaics alone, those a quarter higher
/// not at all. An oak of 16 or 24 is truer to all detail as 9 or 50
/// triangles of mosaics (SSIM 0.94 and 0.91) than as 470 or 1 550 primitives of our law (0.89 and 0.86); at 48 it is
/// not.
inline constexpr double kAllMosaics = 24;
constexpr double no_mosaics(double all_mosaics) { return 1.25 * all_mosaics; }

struct FarTrees {
  static constexpr std::uint32_t kNone = ~0U;
  explicit FarTrees(std::size_t plants, const foliage::HostShaders& host);

  /// With buffers and pictures of its own, so that bringing one more touches no other.
  struct Shown {
    foliage::LdmPack pack;
    std::unique_ptr<foliage::LdmDrawer> drawer;  ///< null: it comes with the next frame
    // Of the frame at hand.
    std::vector<foliage::LdmFar> trees;  ///< of which mosaics show a share
    foliage::LdmSelection chosen;
  };
  std::deque<Shown> packs;             ///< drawers keep their places
  std::vector<std::uint32_t> pack_of;  ///< of each plant; kNone: its trees stay what they are
  std::vector<std::uint32_t> first;    ///< of each plant 0: the only pack of a drawer
  std::vector<std::uint32_t> wanted;   ///< plants without a pack, of which far trees were seen in the last frame
  std::shared_ptr<foliage::LdmPrograms> programs;
  std::vector<foliage::Run> near;  ///< of the frame at hand: sites of which plants show a part
};

/// False: the plant has one.
bool add_pack(FarTrees& far, std::uint32_t plant, foliage::LdmPack pack);
std::size_t bytes_of_packs(const FarTrees& far);  ///< on the device

struct TreesToSplit {
  const foliage::PlantTable& table;
  const foliage::TreesSeen& seen;
  double all_mosaics = kAllMosaics;  ///< 0: all trees are near, but for those of groves
  Groves* groves = nullptr;          ///< that some blocks may be shown as; begin_frame() has been called
  double shadow_at_1m = 0;           ///< crowns that are smaller, a metre away, throw no shadow that could be seen
};
/// Writes rows of visible sites as foliage/gl/extract.h wants them, but for those that groves alone show and whose
/// shadows are not seen; returns how many.
std::uint32_t split_trees(FarTrees& far, const TreesToSplit& trees, std::uint32_t* words);

/// As split_trees() left them. Returns mosaics.
std::uint64_t draw_far_trees(FarTrees& far, int samples, const foliage::Wind& wind = {});

}  // namespace manzana::draw
