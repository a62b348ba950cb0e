#pragma once
/// Textures of imported plants: decoded under a limit, and reduced to the size that plants wear.
#include <optional>
#include <span>

#include "culling/vec.h"
#include "foliage/image.h"

namespace manzana::foliage {

/// Any size, 8 bits a channel, sRGB, straight alpha, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// PNG or JPEG of at most 16 Mi pixels; throws std::runtime_error for what else there is, and for a PNG that inflates
/// to more than it shows.
Picture decode_picture(std::span<const unsigned char> bytes);

struct Tint {
  Vec4 factor{1};                     ///< linear
  std::optional<float> alpha_cutoff;  ///< none: opaque. Mapped to one half, where plants are cut.
};

/// 256 x 256 by areas in linear light, colour weighted by alpha; transparent texels take their neighbour's colour.
Image plant_image(const Picture& picture, const Tint& tint);

Picture plain_picture();  ///< one white pixel, for a material without a texture

}  // namespace manzana::foliage
