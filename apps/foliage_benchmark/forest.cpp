#include "apps/foliage_benchmark/forest.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "culling/hash.h"
#include "culling/overlap.h"
#include "foliage/neighbours.h"

namespace manzana::foliage_benchmark {

double closed_spacing(std::span<const foliage::PreparedPlant> plants) {
  double area = 0;
  for (const foliage::PreparedPlant& plant : plants)
    area += std::numbers::pi * static_cast<double>(plant.crown_radius_m * plant.crown_radius_m);
  return std::sqrt(area / static_cast<double>(plants.size()));
}

std::vector<foliage::TreeSite> make_forest(std::span<const foliage::PreparedPlant> plants, std::uint32_t trees,
                                           double spacing_m, std::uint64_t seed) {
  const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(trees)));
  std::vector<foliage::TreeSite> sites;
  for (std::uint32_t i = 0; i < trees; ++i) {
    const auto random = [&, part = std::uint64_t{0}]() mutable {
      return hash_unit(seed, 8 * std::uint64_t{i} + part++);
    };
    auto next = random;
    const auto kind = i % static_cast<std::uint32_t>(plants.size());
    const auto size = static_cast<float>(0.75 + 0.5 * next()), turn = static_cast<float>(6.28 * next());
    foliage::TreeSite site = make_site(plants[kind], kind, size * plants[kind].height_m,
                                       size * plants[kind].crown_radius_m, turn, hash_bits(seed, i));
    site.position = {
        static_cast<float>(spacing_m * (i % side - side / 2.0 + 0.8 * next())),
        static_cast<float>(spacing_m * (std::floor(static_cast<double>(i) / side) - side / 2.0 + 0.8 * next())), 0};
    sites.push_back(site);
  }
  see_neighbours(sites, plants, rows_seen_from(Vec3d(0)));
  return sites;
}

std::vector<foliage::TreeSite> in_blocks(std::vector<foliage::TreeSite> sites, double side_m) {
  const auto square = [&](const foliage::TreeSite& site) {
    const auto at = [&](float x) { return static_cast<int>(std::floor(static_cast<double>(x) / side_m)); };
    return std::pair(at(site.position.y), at(site.position.x));
  };
  std::ranges::stable_sort(sites, {}, square);
  for (std::size_t i = 1; i < sites.size(); ++i)
    sites[i].block = sites[i - 1].block + (square(sites[i]) != square(sites[i - 1]) ? 1 : 0);
  return sites;
}

std::vector<foliage::Run> in_view(const Stage& stage, std::span<const Extent> extents, const Shot& shot,
                                  std::uint32_t every) {
  const culling::FrustumD frustum = culling::make_frustum(shot.view);
  std::vector<foliage::Run> runs;
  std::uint32_t index = 0, seen = 0;
  for (const foliage::TreeSite& site : stage.sites()) {
    const Extent& extent = extents[site.plant];
    const double half = (extent.high - extent.low) / 2 * static_cast<double>(site.height);
    const double across = extent.radius * static_cast<double>(site.radius);
    const Vec3d middle =
        Vec3d(site.position) + Vec3d(0, 0, (extent.high + extent.low) / 2 * static_cast<double>(site.height));
    const bool out = culling::outside(frustum, culling::kAllPlanes, {middle, std::hypot(half, across)});
    if (!out && seen++ % every == 0) {
      if (!runs.empty() && runs.back().last == index)
        ++runs.back().last;
      else
        runs.push_back({index, index + 1});
    }
    ++index;
  }
  return runs;
}

std::uint64_t trees_of(std::span<const foliage::Run> runs) {
  std::uint64_t trees = 0;
  for (const foliage::Run& run : runs) trees += run.size();
  return trees;
}

std::uint64_t full_primitives(const Stage& stage, std::span<const foliage::Run> runs) {
  std::vector<std::uint64_t> of_plant;
  for (const foliage::PreparedPlant& plant : stage.plants()) {
    const std::size_t bark = plant.branch_levels.empty() ? 0 : plant.branch_levels.front().quads.size();
    of_plant.push_back(2 * (bark + plant.leaves.size()));
  }
  std::uint64_t sum = 0;
  for (const foliage::Run& run : runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) sum += of_plant[stage.sites()[i].plant];
  return sum;
}

Shot screen_shot(const Vec3d& eye, const Vec3d& forward, int height_px) {
  constexpr double kFovY = std::numbers::pi / 3;
  Shot shot;
  shot.width = height_px * 16 / 9;
  shot.height = height_px;
  shot.focal_px = height_px / (2 * std::tan(kFovY / 2));
  shot.view = culling::look(eye, forward, {0, 0, 1}, kFovY, static_cast<double>(shot.width) / height_px);
  return shot;
}

std::vector<Extent> extents_of(std::span<const foliage::PreparedPlant> plants) {
  std::vector<Extent> extents;
  std::transform(plants.begin(), plants.end(), std::back_inserter(extents), extent_of);
  return extents;
}

std::uint64_t covered(const Picture& picture) {
  return static_cast<std::uint64_t>(
      std::count_if(picture.texels.begin(), picture.texels.end(), [](const Vec4& t) { return t.w > 0; }));
}

std::vector<Shot> forest_path(double half_m, int frames, int height_px, double top) {
  std::vector<Shot> shots;
  for (int i = 0; i < frames; ++i) {
    const double t = frames > 1 ? static_cast<double>(i) / (frames - 1) : 0;
    const double height = t < 0.5 ? top * (6 - 8 * t) : std::max(1.7, top * (4 - 6 * t));
    const Vec3d eye(-half_m * (1.1 - 1.2 * t), half_m * 0.1 * std::sin(6 * t), height);
    shots.push_back(screen_shot(eye, {1, 0.2 * std::cos(5 * t), -0.35 + 0.4 * t}, height_px));
  }
  return shots;
}

}  // namespace manzana::foliage_benchmark
