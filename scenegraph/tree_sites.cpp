#include "scenegraph/tree_sites.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "culling/hash.h"
#include "foliage/neighbours.h"

namespace manzana {
namespace {

static_assert(std::tuple_size_v<TreeLeeway> == foliage::glsl::kLeewayAzimuths);

std::vector<Vec4> rows_from_origin(std::span<const BlockFrame> blocks) {
  std::vector<Vec4> rows;
  for (const BlockFrame& block : blocks)
    for (int i = 0; i < 3; ++i)
      rows.emplace_back(Vec4d(block.axes[0][i], block.axes[1][i], block.axes[2][i], block.origin[i]));
  return rows;
}

/// What neighbours hide follows from the sizes of plants, and from how much light they let through.
std::uint64_t sizes_of(std::span<const foliage::PreparedPlant> plants) {
  std::uint64_t hash = 1;
  for (const foliage::PreparedPlant& plant : plants)
    for (const float size : {plant.crown_radius_m, plant.height_m, plant.cover_m2})
      hash = hash_bits(hash, std::bit_cast<std::uint32_t>(size));
  return hash;
}

std::vector<foliage::TreeSite> make_sites(const Scene& scene, std::span<const foliage::PreparedPlant> plants) {
  std::vector<foliage::TreeSite> sites;
  sites.reserve(scene.trees.instances.size());
  for (const TreeInstance& tree : scene.trees.instances) {
    if (tree.plant >= plants.size()) throw std::invalid_argument("a tree's plant is missing");
    foliage::TreeSite& site = sites.emplace_back(
        make_site(plants[tree.plant], tree.plant, tree.height_m, tree.crown_radius_m, tree.yaw, sites.size()));
    site.position = tree.position;
    site.block = tree.block;
    site.hash = (site.hash & ~255U) | tree.tint;
  }
  return sites;
}

}  // namespace

std::vector<foliage::TreeSite> tree_sites(const Scene& scene, std::span<const foliage::PreparedPlant> plants) {
  std::vector<foliage::TreeSite> sites = make_sites(scene, plants);
  const bool known = scene.trees.leeway.size() == sites.size() && scene.trees.leeway_of == sizes_of(plants);
  if (!known) see_neighbours(sites, plants, rows_from_origin(scene.blocks));
  for (std::size_t i = 0; known && i < sites.size(); ++i)
    std::copy(scene.trees.leeway[i].begin(), scene.trees.leeway[i].end(), sites[i].leeway);
  return sites;
}

std::span<const foliage::TreeSite> sites_of(std::span<const foliage::TreeSite> all, std::uint32_t block) {
  return {std::ranges::lower_bound(all, block, {}, &foliage::TreeSite::block),
          std::ranges::upper_bound(all, block, {}, &foliage::TreeSite::block)};
}

void keep_leeway(Scene& scene, std::span<const foliage::PreparedPlant> plants) {
  std::vector<TreeLeeway> leeway;
  for (const foliage::TreeSite& site : tree_sites(scene, plants))
    std::copy_n(site.leeway, TreeLeeway().size(), leeway.emplace_back().begin());
  scene.trees.leeway = {};
  scene.trees.leeway.own() = std::move(leeway);
  scene.trees.leeway_of = sizes_of(plants);
}

}  // namespace manzana
