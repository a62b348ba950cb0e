#pragma once
/// Blocks of trees that are small in the picture, as groves (foliage/grove.h): one thing a block, made when first asked
/// for, within a cap of bytes; those go first that have not been in sight for longest.
///   begin_frame(groves);
///   std::uint32_t shown = grove_share(groves, part, far_trees_of_it);  // of each block in sight: 255ths that it shows
///   end_frame(groves);
///   draw_groves(groves, focal_px, samples);
/// A block has two parts with a grove each, its tall trees (foliage/grove.h) and all others: 2 * block + 1, 2 * block.
/// Its trees show the other samples: nothing is drawn twice. So all of them must be mosaics there already, or the grove
/// takes over at once.
#include <functional>
#include <memory>

#include "foliage/gl/draw_groves.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

struct Groves {
  static constexpr std::uint32_t kAll = foliage::glsl::kAllMosaics;
  static constexpr std::uint32_t kFewTrees = 8;         ///< parts with fewer have none
  static constexpr std::size_t kMostBytes = 64U << 20;  ///< of the device, where nobody says less

  /// Of all trees of the scene, block after block.
  Groves(std::span<const foliage::PreparedPlant> plants, std::span<const foliage::TreeSite> sites, std::size_t blocks,
         const foliage::HostShaders& host, const foliage::GroveOptions& options = {});

  struct Part {
    Vec3 low{0}, high{0};       ///< of its crowns, in the block's frame
    float height_m = 0;         ///< of the largest
    float shadow_radius_m = 0;  ///< of the largest crown that throws a shadow (glsl::kLeastShadow); 0: none does
    foliage::GroveRule rule;    ///< but for what making it tells; without points: it has none
  };
  struct Held {
    foliage::GroveDrawer::Place place;
    foliage::GroveRule rule;
    std::uint32_t level = 0;  ///< of points that are there
  };
  foliage::GroveOptions options;        ///< of all of them
  std::vector<foliage::Run> sites;      ///< of each block
  std::vector<std::uint32_t> tall;      ///< sites of tall parts
  std::vector<foliage::Run> tall_runs;  ///< of `tall`, of each block
  // A row a part.
  std::vector<Part> parts;
  std::vector<foliage::TreeSite> stand_ins;  ///< in the middle of it, hidden as its trees are on average
  std::vector<std::optional<Held>> held;
  std::vector<std::uint64_t> last_used;  ///< the last frame that asked for it; 0: none
  std::unique_ptr<foliage::GroveDrawer> drawer;
  std::size_t most_bytes = kMostBytes;
  std::vector<GroveWanted> wanted;  ///< in the last frame
  // Of the frame at hand.
  std::uint64_t frame = 0;
  std::vector<std::uint64_t> looked_at;  ///< a row a part: the last frame in which it was in sight
  std::vector<std::uint32_t> share;      ///< a row a part: 255ths that its grove shows
  std::vector<foliage::GroveDrawer::Shown> shown;
  std::size_t points_in_use = 0;  ///< held, of parts in sight
};

void begin_frame(Groves& groves);
/// What is wanted is what there is room for, were all groves to go that are not in use.
void end_frame(Groves& groves);

struct GroveView {
  const foliage::PlantTable& table;
  const foliage::TreesSeen& seen;
};
/// `mosaics`: whether all trees of the block are drawn as such; asked only where that counts.
std::uint32_t grove_share(Groves& groves, std::uint32_t part, const GroveView& view,
                          const std::function<bool()>& mosaics);

/// Metres from the eye to the nearest crown of the part, or less.
float distance_to(const Groves& groves, std::uint32_t part, std::span<const Vec4> block_rows);

/// `sites`: of all trees of the scene. For any thread.
foliage::Grove make_grove(std::span<const foliage::PreparedPlant> plants, std::span<const foliage::TreeSite> sites,
                          const GroveWanted& wanted, const foliage::GroveOptions& options = {});
/// What was wanted; groves that are not in sight make room. False: there is none.
bool add_grove(Groves& groves, const GroveWanted& wanted, const foliage::Grove& grove);

/// Points.
std::uint64_t draw_groves(Groves& groves, float focal_px, int samples);

}  // namespace manzana::draw
