#include "scenegraph/draw/far_trees.h"

#include <algorithm>
#include <cmath>

namespace manzana::draw {
namespace {

constexpr std::uint32_t kShift = foliage::glsl::kShareShift, kAll = foliage::glsl::kAllMosaics;

/// Of a tree's height the square, over that of what may be wrong where it stands.
float height2_in_errors(const foliage::PlantTable& table, const foliage::TreesSeen& seen,
                        const foliage::TreeSite& site) {
  const float half = table.plants[site.plant].middle * site.height;
  const Vec4* row = &seen.block_rows[std::size_t{3} * site.block];
  const Vec4 middle(site.position + Vec3(0, 0, half), 1);
  const Vec3 rel(glm::dot(row[0], middle), glm::dot(row[1], middle), glm::dot(row[2], middle));
  const auto error = static_cast<float>(seen.error_at_1m);
  return 4 * half * half / (glm::dot(rel, rel) * error * error);
}

/// 255ths of it that mosaics show.
std::uint32_t share_of(float height2) {
  constexpr auto kLow = static_cast<float>(kAllMosaics), kHigh = static_cast<float>(kNoMosaics);
  if (!(height2 < kHigh * kHigh)) return 0;
  if (height2 <= kLow * kLow) return kAll;
  return static_cast<std::uint32_t>(255 * (kHigh - std::sqrt(height2)) / (kHigh - kLow) + 0.5F);
}

void add_row(std::vector<foliage::Run>& runs, std::uint32_t row) {
  if (!runs.empty() && runs.back().last == row)
    ++runs.back().last;
  else
    runs.push_back({row, row + 1});
}

bool has_pack(FarTrees& far, std::uint32_t plant) {
  if (far.pack_of[plant] != FarTrees::kNone) return true;
  if (std::find(far.wanted.begin(), far.wanted.end(), plant) == far.wanted.end()) far.wanted.push_back(plant);
  return false;
}

}  // namespace

FarTrees::FarTrees(std::size_t plants, const foliage::HostShaders& host)
    : pack_of(plants, kNone), drawer(std::make_unique<foliage::LdmDrawer>(packs, host, host)) {}

void add_pack(FarTrees& far, std::uint32_t plant, foliage::LdmPack pack) {
  far.pack_of[plant] = static_cast<std::uint32_t>(far.packs.size());
  far.packs.push_back(std::move(pack));
  far.drawer->show(far.packs);
}

std::uint32_t split_trees(FarTrees& far, const TreesToSplit& trees, std::uint32_t* words) {
  far.near.clear();
  far.trees.clear();
  far.wanted.clear();
  const foliage::TreesSeen& seen = trees.seen;
  std::uint32_t n = 0;
  for (const foliage::Run& run : seen.runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) {
      const foliage::TreeSite& site = seen.sites[i];
      std::uint32_t share = trees.mosaics ? share_of(height2_in_errors(trees.table, seen, site)) : 0;
      if (share > 0 && !has_pack(far, site.plant)) share = 0;
      if (share < kAll) add_row(far.near, i);
      if (share > 0) far.trees.push_back({i, static_cast<float>(share) / 255});
      words[n++] = share << kShift | i;
    }
  // Where a pixel of the pack's may be as large as what may be wrong.
  if (!far.trees.empty())
    choose_ldm(far.drawer->store().table, {seen.sites, seen.block_rows, {}, 1 / seen.error_at_1m}, far.trees,
               far.pack_of, far.chosen);
  return n;
}

std::uint64_t draw_far_trees(FarTrees& far, int samples) {
  if (far.trees.empty()) return 0;
  far.drawer->draw_dithered(far.chosen, samples);
  return far.chosen.mosaics;
}

}  // namespace manzana::draw
