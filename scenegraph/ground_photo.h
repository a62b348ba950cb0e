#pragma once
/// The ground as it looks from straight above: an orthophoto, which drawing lays over streets, greens and terrain.
///   scene.photo = read_ground_photo("ortho.tif", scene.frame, scene.bounds, "");   // scenegraph/import/read_photo.h
/// Squares in plan, in L; each level has half the squares of the one before, so that drawing may take those that are
/// about as large as its pixels.
#include <array>
#include <cstdint>
#include <vector>

#include "culling/vec.h"

namespace manzana {

/// The default has nothing.
struct GroundPhoto {
  /// sRGB red, green, blue, multiplied by alpha in linear light, and alpha: how much of the square the photo has.
  using Texel = std::array<std::uint8_t, 4>;
  struct Level {
    std::uint32_t columns = 0, rows = 0;
    std::vector<Texel> texels;  ///< row by row from the south, from west to east
  };
  Vec2d origin{0, 0};         ///< the south-western corner of the first square
  double step = 1;            ///< metres a square of the first level
  std::vector<Level> levels;  ///< the last has one square
  bool empty() const { return levels.empty(); }
};

/// From the only level that there is down to one square: each the mean of four, in linear light; beyond the edge there
/// is nothing.
void add_levels(std::vector<GroundPhoto::Level>& levels);

std::size_t bytes_of(const GroundPhoto& photo);

}  // namespace manzana
