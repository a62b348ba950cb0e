#pragma once
/// What is shown of trees as packs of mosaics: which sides and levels of each, and how much of each.
///   LdmSelection chosen;
///   choose_ldm(table, {sites, rows, runs, focal_px}, false, chosen);   // each frame
#include <span>

#include "foliage/ldm_pack.h"
#include "foliage/select.h"

namespace manzana::foliage {

namespace glsl {
#include "foliage/shaders/ldm_layout.glsl"
}  // namespace glsl
using glsl::LdmItem;
using glsl::LdmSideHead;
using glsl::LdmTree;
static_assert(sizeof(LdmTree) == 64 && sizeof(LdmItem) == 32 && sizeof(LdmSideHead) == 80);

/// Packs as the buffers have them, one after the other.
struct LdmTable {
  std::span<const LdmPack> packs;
  std::vector<LdmSideHead> sides;
  std::vector<std::uint32_t> first_side, first_mosaic;  ///< of each pack
};
/// The packs must outlive it.
LdmTable make_ldm_table(std::span<const LdmPack> packs);

struct LdmSeen {
  std::span<const TreeSite> sites;   ///< TreeSite::plant is a pack's number
  std::span<const Vec4> block_rows;  ///< three a block, relative to the eye
  std::span<const Run> runs;         ///< of sites
  double focal_px = 935;             ///< pixels of a metre at a distance of a metre; fewer: coarser levels
};

/// A tree of which mosaics show a share: of each pixel's numbers in [0, 1) those below it.
struct LdmFar {
  std::uint32_t site;
  float share = 1;
};

/// At most three sides times two levels a tree; the eye in a tree's middle, or a weight of 0, shows nothing of it.
/// Intervals of a tree's items follow each other from 0 to its share without a gap. Item i of a tree is one of the same
/// rank i in `ranks`: parts of a picture that are added up must not hide each other.
struct LdmSelection {
  std::vector<LdmTree> trees;
  std::vector<LdmItem> items;
  std::vector<glm::uvec2> groups;  ///< item, first mosaic
  std::array<Run, 6> ranks;        ///< of groups; each rank's trees from the farthest to the nearest where `sorted`
  std::uint64_t mosaics = 0;

  /// Of a tree: a side of its pack at one of its levels. Kept from frame to frame, so that none of them allocates.
  struct Share {
    std::uint32_t tree, side;
    Run mosaics;
    float low, high, grown;
  };
  std::array<std::vector<Share>, 6> shares;
  std::vector<float> distances;  ///< of trees
};

/// sorted: as blending wants it. The dithered choice needs no order.
void choose_ldm(const LdmTable& table, const LdmSeen& seen, bool sorted, LdmSelection& selection);
/// The same of a list of trees, `seen.runs` apart; a plant's pack is `packs` of it.
void choose_ldm(const LdmTable& table, const LdmSeen& seen, std::span<const LdmFar> trees,
                std::span<const std::uint32_t> packs, LdmSelection& selection);

}  // namespace manzana::foliage
