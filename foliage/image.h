#pragma once
/// A picture that a plant wears: of leaves, or of bark.
#include <cstdint>
#include <vector>

namespace manzana::foliage {

/// RGBA, 8 bits, sRGB colour with straight alpha, rows from the top; square, side a power of two. Transparent texels
/// carry the colour of the leaf nearest to them, so that filtering shows no fringe.
struct Image {
  int size = 0;
  std::vector<std::uint8_t> rgba;
};

}  // namespace manzana::foliage
