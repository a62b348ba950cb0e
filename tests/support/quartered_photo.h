#pragma once
/// A picture from the air of a kilometre about a frame's anchor, each quarter of one colour: red in the north-west,
/// blue in the north-east, yellow in the south-west, cyan in the south-east.
#include <algorithm>

#include "tests/import/gis/made_picture.h"

namespace manzana::support {

inline void write_quartered(const std::filesystem::path& file, const LocalFrame& frame) {
  constexpr int kSide = 1000;
  const GeoPoint middle = frame.anchor();
  MadePicture picture{.system = "EPSG:32630", .width = kSide, .height = kSide};
  picture.to_place = placed_at(middle, picture.system, 1, 0, picture);
  write_picture(file, picture, picture.system, [&](const GeoPoint& at) {
    const Vec3d p = frame.to_local(at);
    const int south = p.y < 0 ? 200 : 20;
    return p.x < 0 ? std::array{200, south, 20, 255} : std::array{20, south, 200, 255};
  });
}

inline bool near_a_seam(const Vec3d& at) { return std::min(std::abs(at.x), std::abs(at.y)) < 3; }

/// Whether a lit or shaded colour is that of the quarter.
inline bool is_quarter(int r, int g, int b, const Vec3d& at) {
  const bool west = r > b, south = 2 * g > std::max(r, b);
  return west == (at.x < 0) && south == (at.y < 0);
}

}  // namespace manzana::support
