#pragma once
/// A grove: the trees of a block, seen from afar, as one cloud of points. Where a tree is a handful of pixels high its
/// own data tells no more than a few points do, so that what is drawn should follow the pixels that a wood covers and
/// not how many trees it has.  [the "block of trees" of Zhang 2004's future work, by Deussen's points]
///   Grove grove = make_grove(plants, sites_of_the_block);                    // once, on any thread
///   GroveShown shown = shown_of(grove.rule, {error_m, up}, points_there);    // each frame
/// Each tree gives the first so many points of one of its levels, or of its branches if it has no leaves, as many as it
/// covers squares of the error where it is just too large for a grove. They stand in an order of which every prefix has
/// of each tree its share, spread over its crown, to a point: fewer is "the first so many", with larger areas.
#include <array>
#include <span>

#include "foliage/grove_fit.h"
#include "foliage/plant_table.h"

namespace manzana::foliage {

namespace glsl {
#include "foliage/shaders/grove_layout.glsl"
}  // namespace glsl
using glsl::GroveItem;
static_assert(sizeof(GroveItem) == 32);

/// Where trees give way to their grove, and how fine it is.
struct GroveOptions {
  /// Height of trees in tolerated errors: a grove alone is drawn where all of its are lower, none of it where one is a
  /// quarter higher; 0: nowhere.
  double all = 10;
  double none() const { return 1.25 * all; }
  double points = 0.7;  ///< for each square of the error that trees cover
  bool operator==(const GroveOptions&) const = default;
};

/// What says how many of its points are shown.
struct GroveRule {
  std::uint32_t points = 0;                          ///< all of them
  double per_square = GroveOptions{}.points;         ///< GroveOptions::points
  float cover_m2 = 0;                                ///< the sum of what its trees hide, from their sides
  std::array<float, kGroveViews> cover{1, 1, 1, 1};  ///< from each view, over that
  /// By what areas are multiplied, so that points cover what trees do, times the share that is meant of all: where as
  /// many are meant as there is room for, half of them, and so on.
  using Table = std::array<std::array<float, 20>, kGroveViews>;
  Table worth{};
  Table light{};  ///< by what points are lighter then
};
struct Grove {
  /// The first so many; in the block's frame.
  std::vector<LeafPoint> points;
  GroveRule rule;
};

/// Of a block's trees the tall ones, more than four times as high as most, or all others: each have a grove of their
/// own, since grass would have to wait for the oaks that stand on it. By rows; linear.
std::vector<std::uint32_t> grove_rows(std::span<const PreparedPlant> plants, std::span<const TreeSite> sites,
                                      bool tall);

/// What it will have, but for `worth`; cheap.
GroveRule grove_rule(std::span<const PreparedPlant> plants, std::span<const TreeSite> sites,
                     const GroveOptions& options = {});
/// `level`: half as many of its points as those of the level before; 0: all.
Grove make_grove(std::span<const PreparedPlant> plants, std::span<const TreeSite> sites, std::uint32_t level = 0,
                 const GroveOptions& options = {});
inline std::uint32_t points_at(std::uint32_t all, std::uint32_t level) { return (all + (1U << level) - 1) >> level; }

/// The first `count` points, their areas times `scale`, their light times `light`; those near `edge` shrink away, over
/// `fade` ranks.
struct GroveShown {
  std::uint32_t count = 0;
  float edge = 0, fade = 1, scale = 1, light = 1;
};
/// How it is seen.
struct GroveSight {
  double error_m = 1;     ///< that may be wrong where it stands
  double up = 0;          ///< sine of the eye's elevation over it
  double times = 1;       ///< by how much more may be wrong of what others hide
  Vec2d outline_m{0, 0};  ///< across the line of sight: of what holds all crowns; 0: not known
};
/// `there`: the first so many points are.
GroveShown shown_of(const GroveRule& rule, const GroveSight& sight, std::uint32_t there);
/// The last level that has as many as that asks for.
std::uint32_t level_of(const GroveRule& rule, const GroveSight& sight);

}  // namespace manzana::foliage
