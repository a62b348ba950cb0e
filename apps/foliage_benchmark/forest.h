#pragma once
/// Many plants on level ground, and what of them is in view.
#include "apps/foliage_benchmark/stage.h"

namespace manzana::foliage_benchmark {

/// Of a closed forest: the ground of a tree is as large as a crown.
double closed_spacing(std::span<const foliage::PreparedPlant> plants);

/// A square of trees, their species by turns, each turned and of its own size, about `spacing_m` apart; the middle is
/// the origin. What they hide of each other is known.
std::vector<foliage::TreeSite> make_forest(std::span<const foliage::PreparedPlant> plants, std::uint32_t trees,
                                           double spacing_m, std::uint64_t seed);

/// Blocks of so many metres a side, one after the other, as a city has its trees.
std::vector<foliage::TreeSite> in_blocks(std::vector<foliage::TreeSite> sites, double side_m);

/// Trees whose balls are not certainly out of view, as runs; of these every `every`th.
std::vector<foliage::Run> in_view(const Stage& stage, std::span<const Extent> extents, const Shot& shot,
                                  std::uint32_t every = 1);
std::uint64_t trees_of(std::span<const foliage::Run> runs);

/// Primitives of all detail.
std::uint64_t full_primitives(const Stage& stage, std::span<const foliage::Run> runs);

/// A camera of a screen, 16 : 9.
Shot screen_shot(const Vec3d& eye, const Vec3d& forward, int height_px);

std::vector<Extent> extents_of(std::span<const foliage::PreparedPlant> plants);
std::uint64_t covered(const Picture& picture);  ///< pixels that plants cover, however little

/// Over a forest that reaches so far to all sides and so high, then down into it.
std::vector<Shot> forest_path(double half_m, int frames, int height_px, double top_m);

}  // namespace manzana::foliage_benchmark
