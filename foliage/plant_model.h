#pragma once
/// A plant ready to be drawn: bark and leaves, kept apart, in levels of detail.
///   PlantModel oak = generate_plant(species, seed);       // foliage/generate.h
///   PlantModel pine = import_plant("pine.glb");           // foliage/import/gltf_plant.h
/// THE SEAM: what draws a tree knows PlantModel::levels and select_level() only. A new representation is a new kind of
/// level here, and one file in foliage/gl that draws it.
#include <cstdint>
#include <string>
#include <vector>

#include "culling/vec.h"

namespace manzana::foliage {

/// 24 bytes. Position in the plant's own frame, scaled so that the foot is the origin, z is up, the top is at z = 1 and
/// the farthest vertex from the axis is at distance 1; so an instance of height h and crown radius r is scaled by (r,
/// r, h).
struct PlantVertex {
  Vec3 position;
  std::uint32_t normal;  ///< signed normalised 10-10-10-2, of the unscaled plant
  std::uint16_t u, v;    ///< unsigned normalised, times kUvRange
  std::uint8_t shade;    ///< 255 outside in the light, less deep in the crown: ambient light that arrives
  std::uint8_t leaf;     ///< 0 bark, 1 leaf
  std::uint16_t unused = 0;
};
static_assert(sizeof(PlantVertex) == 24);
inline constexpr float kUvRange = 8;  // bark repeats up to eight times

/// The bark's triangles come first: indices [0, bark_indices) bark, the rest leaves.
struct PlantLevel {
  std::vector<PlantVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::uint32_t bark_indices = 0;
  float min_radius_px = 0;  ///< drawn while the crown's ball has at least this radius on the screen
};

/// RGBA, 8 bits, sRGB colour with straight alpha, rows from the top; square, side a power of two. Transparent texels
/// carry the colour of the leaf nearest to them, so that filtering shows no fringe.
struct Image {
  int size = 0;
  std::vector<std::uint8_t> rgba;
};

struct PlantModel {
  std::string name;
  float height_m = 10, crown_radius_m = 3;  ///< its size by nature
  Image leaf, bark;                         ///< 256 x 256 each
  std::vector<PlantLevel> levels;           ///< finest first; min_radius_px falls to 0 at the last
};

/// The level for a crown of that radius on the screen, in pixels.
inline std::size_t select_level(const PlantModel& model, double radius_px) {
  std::size_t level = 0;
  while (level + 1 < model.levels.size() && radius_px < static_cast<double>(model.levels[level].min_radius_px)) ++level;
  return level;
}

}  // namespace manzana::foliage
