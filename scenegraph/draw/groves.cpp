#include "scenegraph/draw/groves.h"

#include <algorithm>
#include <cmath>

namespace manzana::draw {
namespace {

using foliage::TreeSite;

Groves::Block block_of(std::span<const foliage::PreparedPlant> plants, std::span<const TreeSite> all,
                       const foliage::Run& run) {
  Groves::Block block;
  block.sites = run;
  block.low = Vec3(INFINITY), block.high = Vec3(-INFINITY);
  const auto sites = all.subspan(run.first, run.size());
  for (const TreeSite& site : sites) {
    const foliage::PreparedPlant& plant = plants[site.plant];
    const float height = plant.height_m * site.height, radius = plant.crown_radius_m * site.radius;
    block.height_m = std::max(block.height_m, height);
    block.crown_radius_m = std::max(block.crown_radius_m, radius);
    block.low = glm::min(block.low, site.position - Vec3(radius, radius, 0));
    block.high = glm::max(block.high, site.position + Vec3(radius, radius, height));
  }
  if (run.size() >= Groves::kFewTrees) block.rule = grove_rule(plants, sites);
  return block;
}

/// Of four bytes a word, the mean of each over the sites.
std::uint32_t mean_leeway(std::span<const TreeSite> sites, std::size_t azimuth) {
  std::uint32_t word = 0;
  for (unsigned byte = 0; byte < 4; ++byte) {
    std::uint64_t sum = 0;
    for (const TreeSite& site : sites) sum += site.leeway[azimuth] >> (8 * byte) & 255U;
    word |= static_cast<std::uint32_t>(sum / sites.size()) << (8 * byte);
  }
  return word;
}

TreeSite stand_in_of(std::span<const TreeSite> sites, const Groves::Block& block) {
  TreeSite site = sites.front();
  site.position = 0.5F * (block.low + block.high);
  site.radius = site.height = 0;
  site.inv_scale2 = 1;
  for (std::size_t azimuth = 0; azimuth < std::size(site.leeway); ++azimuth)
    site.leeway[azimuth] = mean_leeway(sites, azimuth);
  return site;
}

/// 255ths; 0 where a tree is high.
std::uint32_t share_at(double height_in_errors) {
  using foliage::kAllGrove, foliage::kNoGrove;
  return static_cast<std::uint32_t>(
      Groves::kAll * std::clamp((kNoGrove - height_in_errors) / (kNoGrove - kAllGrove), 0.0, 1.0) + 0.5);
}

std::size_t room_in_points(const Groves& groves) {
  constexpr std::size_t kShareOfPages = 10;  // a tenth is lost between groves
  return groves.most_bytes / sizeof(foliage::LeafPoint) * (kShareOfPages - 1) / kShareOfPages;
}

/// In the block's frame.
Vec3 eye_of(std::span<const Vec4> block_rows, std::uint32_t block) {
  const Vec4* row = &block_rows[std::size_t{3} * block];
  return -(Vec3(row[0]) * row[0].w + Vec3(row[1]) * row[1].w + Vec3(row[2]) * row[2].w);
}

foliage::GroveSight sight_of(const Groves& groves, std::uint32_t block, const GroveView& view) {
  foliage::TreesSeen seen = view.seen;
  seen.sites = groves.stand_ins;
  const foliage::TreeError error = error_of_tree(view.table, seen, block);
  const double distance = std::sqrt(static_cast<double>(error.distance2)), error_m = distance * view.seen.error_at_1m;
  const Vec3 eye = eye_of(view.seen.block_rows, block) - groves.stand_ins[block].position;
  const Vec3d size(groves.blocks[block].high - groves.blocks[block].low);
  const double up = std::clamp(static_cast<double>(eye.z) / distance, -1.0, 1.0), across = std::sqrt(size.x * size.y);
  return {error_m,
          up,
          std::sqrt(static_cast<double>(error.error2)) / error_m,
          {across, across * std::abs(up) + size.z * std::sqrt(1 - up * up)}};
}

std::uint32_t find_share(Groves& groves, std::uint32_t block, const GroveView& view,
                         const std::function<bool()>& mosaics) {
  constexpr double kSoon = 1.1;  // wanted before it is needed
  const Groves::Block& of = groves.blocks[block];
  if (of.rule.points == 0) return 0;
  const double distance = static_cast<double>(distance_to(groves, block, view.seen.block_rows)),
               height = static_cast<double>(of.height_m) / (distance * view.seen.error_at_1m);
  if (!(height < kSoon * foliage::kNoGrove)) return 0;
  const foliage::GroveSight sight = sight_of(groves, block, view);
  const std::uint32_t level = level_of(of.rule, {sight.error_m / kSoon, 0, sight.times, {}});
  auto& held = groves.held[block];
  if (!held || held->level > level) groves.wanted.push_back({block, level});
  if (!held) return 0;
  groves.points_in_use += held->place.points;
  groves.last_used[block] = groves.frame;
  const std::uint32_t share = share_at(height);
  if (share == 0 || (share < Groves::kAll && !mosaics())) return 0;
  groves.shown.push_back({block, held->place, shown_of(held->rule, sight, held->place.points), Groves::kAll - share});
  return share;
}

void release(Groves& groves, std::size_t block) {
  groves.drawer->remove(groves.held[block]->place);
  groves.held[block].reset();
}

/// Of those that are not in sight the one that has been for longest not.
bool release_oldest(Groves& groves) {
  std::size_t oldest = groves.held.size();
  for (std::size_t block = 0; block < groves.held.size(); ++block)
    if (groves.held[block] && groves.last_used[block] < groves.frame &&
        (oldest == groves.held.size() || groves.last_used[block] < groves.last_used[oldest]))
      oldest = block;
  if (oldest == groves.held.size()) return false;
  release(groves, oldest);
  return true;
}

}  // namespace

Groves::Groves(std::span<const foliage::PreparedPlant> plants, std::span<const TreeSite> sites, std::size_t all_blocks,
               const foliage::HostShaders& host)
    : blocks(all_blocks),
      stand_ins(all_blocks),
      held(all_blocks),
      last_used(all_blocks),
      drawer(std::make_unique<foliage::GroveDrawer>(host)),
      looked_at(all_blocks),
      share(all_blocks) {
  for (std::uint32_t first = 0, end = 0; first < sites.size(); first = end) {
    const std::uint32_t block = sites[first].block;
    for (end = first; end < sites.size() && sites[end].block == block;) ++end;
    blocks[block] = block_of(plants, sites, {first, end});
    stand_ins[block] = stand_in_of(sites.subspan(first, end - first), blocks[block]);
    stand_ins[block].block = block;
  }
}

void begin_frame(Groves& groves) {
  ++groves.frame;
  groves.wanted.clear();
  groves.shown.clear();
  groves.points_in_use = 0;
}

void end_frame(Groves& groves) {
  std::size_t points = groves.points_in_use;
  std::erase_if(groves.wanted, [&](const GroveWanted& wanted) {
    const std::uint32_t more = foliage::points_at(groves.blocks[wanted.block].rule.points, wanted.level);
    const bool room = more <= foliage::GroveDrawer::kPage && points + more <= room_in_points(groves);
    points += room ? more : 0;
    return !room;
  });
}

std::uint32_t grove_share(Groves& groves, std::uint32_t block, const GroveView& view,
                          const std::function<bool()>& mosaics) {
  if (groves.looked_at[block] != groves.frame) {
    groves.looked_at[block] = groves.frame;
    groves.share[block] = find_share(groves, block, view, mosaics);
  }
  return groves.share[block];
}

float distance_to(const Groves& groves, std::uint32_t block, std::span<const Vec4> block_rows) {
  const Groves::Block& of = groves.blocks[block];
  const Vec3 eye = eye_of(block_rows, block);
  return glm::length(eye - glm::clamp(eye, of.low, of.high));
}

bool add_grove(Groves& groves, const GroveWanted& wanted, const foliage::Grove& grove) {
  if (groves.held[wanted.block]) release(groves, wanted.block);
  groves.drawer->limit(groves.most_bytes / foliage::GroveDrawer::kPageBytes);
  for (;;) {
    if (const auto place = groves.drawer->add(grove.points)) {
      groves.held[wanted.block] = {*place, grove.rule, wanted.level};
      return true;
    }
    if (!release_oldest(groves)) return false;
  }
}

std::uint64_t draw_groves(Groves& groves, float focal_px, int samples) {
  return groves.drawer->draw(groves.shown, focal_px, samples);
}

}  // namespace manzana::draw
