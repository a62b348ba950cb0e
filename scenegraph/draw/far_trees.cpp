#include "scenegraph/draw/far_trees.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace manzana::draw {
namespace {

// Pictures of a tree are of parallel light, and of its outside: whatever may be wrong, they show nothing of a tree that
// is nearer than twice its height.
double most_error(double all_mosaics) { return 0.5 / no_mosaics(all_mosaics); }

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
std::uint32_t share_of(float height2, double all_mosaics) {
  const auto low = static_cast<float>(all_mosaics), high = static_cast<float>(no_mosaics(all_mosaics));
  if (!(height2 < high * high)) return 0;
  if (height2 <= low * low) return kAll;
  return static_cast<std::uint32_t>(255 * (high - std::sqrt(height2)) / (high - low) + 0.5F);
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
    : pack_of(plants, kNone), first(plants, 0), programs(std::make_shared<foliage::LdmPrograms>(host, host)) {}

bool add_pack(FarTrees& far, std::uint32_t plant, foliage::LdmPack pack) {
  if (far.pack_of[plant] != FarTrees::kNone) return false;
  far.pack_of[plant] = static_cast<std::uint32_t>(far.packs.size());
  far.packs.emplace_back().pack = std::move(pack);
  return true;
}

std::size_t bytes_of_packs(const FarTrees& far) {
  std::size_t bytes = 0;
  for (const auto& [pack, drawer, trees, chosen] : far.packs)
    bytes += pack.colour.size() + pack.surface.size() + pack.mosaic_bytes();
  return bytes;
}

namespace {

/// Of a frame: tree after tree, block after block.
class Splitter {
 public:
  Splitter(FarTrees& far, const TreesToSplit& trees, const foliage::TreesSeen& seen, std::uint32_t* words)
      : far_(far), trees_(trees), seen_(seen), words_(words) {}

  /// Sites of one block.
  void add(const foliage::Run& sites) {
    if (trees_.groves == nullptr) {
      for (std::uint32_t i = sites.first; i < sites.last; ++i) add_tree(i, kAll);
      return;
    }
    const Groves& groves = *trees_.groves;
    const std::uint32_t block = seen_.sites[sites.first].block;
    const InPart low = in_part(2 * block), high = in_part(2 * block + 1);
    const foliage::Run& run = groves.tall_runs[block];
    const auto tall = std::span(groves.tall).subspan(run.first, run.size());
    auto next = std::ranges::lower_bound(tall, sites.first);
    if (low.grove == kAll && !low.shadows) {
      for (; next != tall.end() && *next < sites.last; ++next) add(*next, high);
      return;
    }
    for (std::uint32_t i = sites.first; i < sites.last; ++i) {
      const bool is_tall = next != tall.end() && *next == i;
      add(i, is_tall ? high : low);
      if (is_tall) ++next;
    }
  }
  std::uint32_t words() const { return n_; }

 private:
  /// What is shown of the trees of a part of a block by others.
  struct InPart {
    std::uint32_t grove = 0;  ///< 255ths
    bool shadows = false;     ///< they throw some that can be seen, although they themselves cannot
  };

  InPart in_part(std::uint32_t part) {
    const std::uint32_t grove = share_of_grove(part);
    return {grove, grove == kAll && throws_shadows(part)};
  }

  void add(std::uint32_t i, const InPart& part) {
    if (part.grove < kAll)
      add_tree(i, kAll - part.grove);
    else if (part.shadows)
      words_[n_++] = kAll << kShift | i;
  }

  /// `most`: 255ths that the grove leaves.
  void add_tree(std::uint32_t i, std::uint32_t most) {
    const foliage::TreeSite& site = seen_.sites[i];
    std::uint32_t share = share_of(height2_in_errors(trees_.table, seen_, site), trees_.all_mosaics);
    if (share > 0 && !has_pack(far_, site.plant)) share = 0;
    if (share < kAll) add_row(far_.near, i);
    if (share > 0)
      far_.packs[far_.pack_of[site.plant]].trees.push_back({i, static_cast<float>(std::min(share, most)) / 255});
    words_[n_++] = share << kShift | i;
  }

  std::uint32_t share_of_grove(std::uint32_t part) {
    const auto mosaics = [&] {
      const foliage::Run& all = trees_.groves->sites[part / 2];
      bool have = trees_.all_mosaics >= trees_.groves->options.none();
      for (std::uint32_t i = all.first; i < all.last; ++i) have = has_pack(far_, seen_.sites[i].plant) && have;
      return have;
    };
    return grove_share(*trees_.groves, part, {trees_.table, seen_}, mosaics);
  }

  bool throws_shadows(std::uint32_t part) const {
    const auto radius = static_cast<double>(trees_.groves->parts[part].shadow_radius_m);
    return radius > trees_.shadow_at_1m * static_cast<double>(distance_to(*trees_.groves, part, seen_.block_rows));
  }

  FarTrees& far_;
  const TreesToSplit& trees_;
  const foliage::TreesSeen& seen_;
  std::uint32_t* words_;
  std::uint32_t n_ = 0;
};

}  // namespace

std::uint32_t split_trees(FarTrees& far, const TreesToSplit& trees, std::uint32_t* words) {
  far.near.clear();
  far.wanted.clear();
  for (FarTrees::Shown& shown : far.packs) {
    shown.trees.clear();
    if (!shown.drawer) shown.drawer = std::make_unique<foliage::LdmDrawer>(std::span(&shown.pack, 1), far.programs);
  }
  foliage::TreesSeen seen = trees.seen;
  seen.error_at_1m = std::min(seen.error_at_1m, most_error(trees.all_mosaics));
  Splitter splitter(far, trees, seen, words);
  for (const foliage::Run& run : seen.runs)
    for (std::uint32_t first = run.first, last = first; first < run.last; first = last) {
      while (last < run.last && seen.sites[last].block == seen.sites[first].block) ++last;
      splitter.add({first, last});
    }
  // Where a pixel of the pack's may be as large as what may be wrong.
  for (FarTrees::Shown& shown : far.packs)
    choose_ldm(shown.drawer->store().table, {seen.sites, seen.block_rows, {}, 1 / seen.error_at_1m}, shown.trees,
               far.first, shown.chosen);
  return splitter.words();
}

std::uint64_t draw_far_trees(FarTrees& far, int samples, const foliage::Wind& wind) {
  std::uint64_t mosaics = 0;
  for (FarTrees::Shown& shown : far.packs) {
    if (shown.trees.empty()) continue;
    shown.drawer->draw_dithered(shown.chosen, samples, wind);
    mosaics += shown.chosen.mosaics;
  }
  return mosaics;
}

}  // namespace manzana::draw
