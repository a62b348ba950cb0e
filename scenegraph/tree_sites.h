#pragma once
/// The scene's trees as foliage has them: where they stand, and what of each its neighbours hide.
///   keep_leeway(scene, plants);                        // once, before it is baked: some seconds for 100 000 trees
///   const auto sites = tree_sites(scene, plants);      // found there, where the plants are of the same sizes
#include <span>
#include <vector>

#include "foliage/select.h"
#include "scenegraph/scene.h"

namespace manzana {

/// A site for each tree, in the same order. Throws std::invalid_argument for a tree without a plant.
std::vector<foliage::TreeSite> tree_sites(const Scene& scene, std::span<const foliage::PreparedPlant> plants);

/// Those of a block; all are block after block.
std::span<const foliage::TreeSite> sites_of(std::span<const foliage::TreeSite> all, std::uint32_t block);

void keep_leeway(Scene& scene, std::span<const foliage::PreparedPlant> plants);

}  // namespace manzana
