#include "scenegraph/draw/groves.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/tree_sites.h"

namespace manzana::draw {
namespace {

using foliage::TreeSite;

using Sites = std::vector<TreeSite>;

Groves::Part part_of(std::span<const foliage::PreparedPlant> plants, const Sites& sites,
                     const foliage::GroveOptions& options) {
  Groves::Part part;
  part.low = Vec3(INFINITY), part.high = Vec3(-INFINITY);
  for (const TreeSite& site : sites) {
    const foliage::PreparedPlant& plant = plants[site.plant];
    const float height = plant.height_m * site.height, radius = plant.crown_radius_m * site.radius;
    part.height_m = std::max(part.height_m, height);
    if (density_of(plant) >= foliage::glsl::kLeastShadow) part.shadow_radius_m = std::max(part.shadow_radius_m, radius);
    part.low = glm::min(part.low, site.position - Vec3(radius, radius, 0));
    part.high = glm::max(part.high, site.position + Vec3(radius, radius, height));
  }
  if (sites.size() >= Groves::kFewTrees) part.rule = grove_rule(plants, sites, options);
  return part;
}

Sites sites_in(std::span<const TreeSite> of_block, std::span<const std::uint32_t> rows) {
  Sites sites;
  for (const std::uint32_t row : rows) sites.push_back(of_block[row]);
  return sites;
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

TreeSite stand_in_of(std::span<const TreeSite> sites, const Groves::Part& part) {
  TreeSite site = sites.front();
  site.position = 0.5F * (part.low + part.high);
  site.radius = site.height = 0;
  site.inv_scale2 = 1;
  for (std::size_t azimuth = 0; azimuth < std::size(site.leeway); ++azimuth)
    site.leeway[azimuth] = mean_leeway(sites, azimuth);
  return site;
}

/// 255ths; 0 where a tree is high.
std::uint32_t share_at(const foliage::GroveOptions& options, double height_in_errors) {
  const double none = options.none(), share = (none - height_in_errors) / (none - options.all);
  return static_cast<std::uint32_t>(Groves::kAll * std::clamp(share, 0.0, 1.0) + 0.5);
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

foliage::GroveSight sight_of(const Groves& groves, std::uint32_t part, const GroveView& view) {
  foliage::TreesSeen seen = view.seen;
  seen.sites = groves.stand_ins;
  const foliage::TreeError error = error_of_tree(view.table, seen, part);
  const double distance = glm::length(Vec3d(error.middle)), error_at_1m = view.seen.error_at_1m;
  const Vec3 eye = eye_of(view.seen.block_rows, part / 2) - groves.stand_ins[part].position;
  const Vec3d size(groves.parts[part].high - groves.parts[part].low);
  const double up = std::clamp(static_cast<double>(eye.z) / distance, -1.0, 1.0), across = std::sqrt(size.x * size.y);
  return {static_cast<double>(distance_to(groves, part, view.seen.block_rows)) * error_at_1m,  // a meadow begins near
          up,
          std::sqrt(static_cast<double>(error.error2)) / (distance * error_at_1m),
          {across, across * std::abs(up) + size.z * std::sqrt(1 - up * up)}};
}

std::uint32_t find_share(Groves& groves, std::uint32_t part, const GroveView& view,
                         const std::function<bool()>& mosaics) {
  constexpr double kSoon = 1.1;  // wanted before it is needed
  const Groves::Part& of = groves.parts[part];
  if (of.rule.points == 0) return 0;
  const double distance = static_cast<double>(distance_to(groves, part, view.seen.block_rows)),
               height = static_cast<double>(of.height_m) / (distance * view.seen.error_at_1m);
  if (!(height < kSoon * groves.options.none())) return 0;
  const foliage::GroveSight sight = sight_of(groves, part, view);
  const std::uint32_t level = level_of(of.rule, {sight.error_m / kSoon, sight.up, sight.times, {}});
  auto& held = groves.held[part];
  if (!held || held->level > level) groves.wanted.push_back({part, level});
  if (!held) return 0;
  groves.points_in_use += held->place.points;
  groves.last_used[part] = groves.frame;
  if (held->level > level_of(of.rule, sight)) return 0;  // its points would be squares of several errors
  const std::uint32_t share = share_at(groves.options, height);
  if (share == 0 || (share < Groves::kAll && !mosaics())) return 0;
  groves.shown.push_back(
      {part / 2, held->place, shown_of(held->rule, sight, held->place.points), Groves::kAll - share});
  return share;
}

void release(Groves& groves, std::size_t part) {
  groves.drawer->remove(groves.held[part]->place);
  groves.held[part].reset();
}

/// Of those that are not in sight the one that has been for longest not.
bool release_oldest(Groves& groves) {
  std::size_t oldest = groves.held.size();
  for (std::size_t part = 0; part < groves.held.size(); ++part)
    if (groves.held[part] && groves.last_used[part] < groves.frame &&
        (oldest == groves.held.size() || groves.last_used[part] < groves.last_used[oldest]))
      oldest = part;
  if (oldest == groves.held.size()) return false;
  release(groves, oldest);
  return true;
}

void add_part(Groves& groves, std::span<const foliage::PreparedPlant> plants, std::span<const TreeSite> of_block,
              std::uint32_t block, bool tall) {
  const std::vector<std::uint32_t> rows = grove_rows(plants, of_block, tall);
  if (rows.empty()) return;
  const Sites sites = sites_in(of_block, rows);
  const std::size_t part = std::size_t{2} * block + (tall ? 1 : 0);
  groves.parts[part] = part_of(plants, sites, groves.options);
  groves.stand_ins[part] = stand_in_of(sites, groves.parts[part]);
  if (!tall) return;
  const auto first = static_cast<std::uint32_t>(groves.tall.size());
  for (const std::uint32_t row : rows) groves.tall.push_back(groves.sites[block].first + row);
  groves.tall_runs[block] = {first, static_cast<std::uint32_t>(groves.tall.size())};
}

}  // namespace

Groves::Groves(std::span<const foliage::PreparedPlant> plants, std::span<const TreeSite> all, std::size_t all_blocks,
               const foliage::HostShaders& host, const foliage::GroveOptions& how)
    : options(how),
      sites(all_blocks),
      tall_runs(all_blocks),
      parts(2 * all_blocks),
      stand_ins(2 * all_blocks),
      held(2 * all_blocks),
      last_used(2 * all_blocks),
      drawer(std::make_unique<foliage::GroveDrawer>(host)),
      looked_at(2 * all_blocks),
      share(2 * all_blocks) {
  for (std::uint32_t first = 0, end = 0; first < all.size(); first = end) {
    const std::uint32_t block = all[first].block;
    for (end = first; end < all.size() && all[end].block == block;) ++end;
    sites[block] = {first, end};
    for (const bool is_tall : {false, true}) add_part(*this, plants, all.subspan(first, end - first), block, is_tall);
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
    const std::uint32_t more = foliage::points_at(groves.parts[wanted.part].rule.points, wanted.level);
    const bool room = more <= foliage::GroveDrawer::kPage && points + more <= room_in_points(groves);
    points += room ? more : 0;
    return !room;
  });
}

std::uint32_t grove_share(Groves& groves, std::uint32_t part, const GroveView& view,
                          const std::function<bool()>& mosaics) {
  if (groves.looked_at[part] != groves.frame) {
    groves.looked_at[part] = groves.frame;
    groves.share[part] = find_share(groves, part, view, mosaics);
  }
  return groves.share[part];
}

float distance_to(const Groves& groves, std::uint32_t part, std::span<const Vec4> block_rows) {
  const Groves::Part& of = groves.parts[part];
  const Vec3 eye = eye_of(block_rows, part / 2);
  return glm::length(eye - glm::clamp(eye, of.low, of.high));
}

foliage::Grove make_grove(std::span<const foliage::PreparedPlant> plants, std::span<const TreeSite> sites,
                          const GroveWanted& wanted, const foliage::GroveOptions& options) {
  const auto of_block = sites_of(sites, wanted.part / 2);
  return foliage::make_grove(plants, sites_in(of_block, grove_rows(plants, of_block, wanted.part % 2 == 1)),
                             wanted.level, options);
}

bool add_grove(Groves& groves, const GroveWanted& wanted, const foliage::Grove& grove) {
  if (groves.held[wanted.part]) release(groves, wanted.part);
  groves.drawer->limit(groves.most_bytes / foliage::GroveDrawer::kPageBytes);
  for (;;) {
    if (const auto place = groves.drawer->add(grove.points)) {
      groves.held[wanted.part] = {*place, grove.rule, wanted.level};
      return true;
    }
    if (!release_oldest(groves)) return false;
  }
}

std::uint64_t draw_groves(Groves& groves, float focal_px, int samples) {
  return groves.drawer->draw(groves.shown, focal_px, samples);
}

}  // namespace manzana::draw
