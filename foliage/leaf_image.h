#pragma once
/// The pictures that a generated plant wears, drawn by code: a twig with many leaves, and bark.
#include <array>
#include <optional>
#include <string>

#include "foliage/plant.h"

namespace manzana::foliage {

inline constexpr int kPlantImageSize = 256;

/// A twig that grows from the middle of the lower edge to the upper one. `shape`: oval, round, lobed, heart, lance,
/// needle, tuft or frond; `rgb`: sRGB 0xrrggbb of its leaves. Throws std::invalid_argument for another shape.
/// With a flower or a fruit the twig keeps to the upper three quarters, and the organ has a square of a quarter's side
/// in the lower left corner.
struct OrganLook {
  Organ organ = Organ::fruit;
  std::uint32_t rgb = 0xb03030;
};
inline constexpr float kOrganSide = 0.25F;
Image leaf_image(const std::string& shape, std::uint32_t rgb, std::uint64_t seed,
                 const std::optional<OrganLook>& organ = std::nullopt);

/// Repeats without a seam in both directions; ridges run along v.
Image bark_image(std::uint32_t rgb, std::uint64_t seed);

/// Gives texels whose alpha is 0 the colour of the nearest that has some. Grey where none has.
void dilate_colour(Image& image);

float linear_of_srgb(std::uint8_t value);  ///< [0, 1]
using LinearBytes = std::array<float, 256>;
const LinearBytes& linear_of_srgb();       ///< of each byte, for many at once
std::uint8_t srgb_of_linear(float value);  ///< clamped
Vec3 linear_of_rgb(std::uint32_t rgb);     ///< of 0xrrggbb

/// Of linear light.  [ITU-R BT.709]
inline float luminance(const Vec3& c) { return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z; }

}  // namespace manzana::foliage
