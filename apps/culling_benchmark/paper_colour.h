#pragma once
/// What the generated city looks like: colours with the light of one sun in them, so that the shader has none to do.
#include <array>
#include <cstdint>
#include <span>

#include "culling/hash.h"
#include "culling/vec.h"
#include "scenegraph/draw/car_model.h"

namespace manzana::paper {

inline constexpr Vec3 kSky{0.62F, 0.75F, 0.90F}, kGround{0.42F, 0.42F, 0.41F}, kBark{0.32F, 0.25F, 0.18F};

/// sRGB, each within [0, 1], to bytes.
inline std::uint32_t pack(const Vec3& colour) {
  const glm::uvec3 c(glm::clamp(colour, 0.0F, 1.0F) * 255.0F + 0.5F);
  return c.r | c.g << 8 | c.b << 16 | 255U << 24;
}
inline std::uint32_t mean(std::uint32_t a, std::uint32_t b) {
  return (a & b) + ((a ^ b) >> 1 & 0x7f7f7f7fU);  // of each byte, rounded down
}
inline std::uint32_t tinted(std::uint32_t colour, const Vec3& tint) {
  return pack(tint * Vec3(colour & 255U, colour >> 8 & 255U, colour >> 16 & 255U) / 255.0F);
}

/// On a face with that normal, of any length.
inline float light(const Vec3& normal) {
  const Vec3 sun = glm::normalize(Vec3(-0.55F, -0.35F, 0.75F));
  return 0.55F + 0.45F * glm::max(0.0F, glm::dot(glm::normalize(normal), sun));
}
/// A car turns under the sun: only what lies flat is lit. Normal as signed normalised 10-10-10-2.
inline float light_on_car(std::uint32_t normal) {
  const auto z = static_cast<std::int32_t>(normal << 2) >> 22;
  return 0.7F + 0.3F * static_cast<float>(z) / 511.0F;
}

inline Vec3 one_of(std::span<const Vec3> colours, std::uint64_t seed, std::uint64_t stream) {
  return colours[hash_bits(seed, stream) % colours.size()] *
         (0.9F + 0.1F * static_cast<float>(hash_unit(seed, stream)));
}
inline Vec3 wall_colour(std::uint64_t seed) {
  constexpr std::array kWalls{Vec3(0.93F, 0.88F, 0.78F), Vec3(0.85F, 0.72F, 0.60F), Vec3(0.80F, 0.80F, 0.78F),
                              Vec3(0.72F, 0.50F, 0.42F), Vec3(0.94F, 0.93F, 0.90F), Vec3(0.90F, 0.80F, 0.58F)};
  return one_of(kWalls, seed, 10);
}
inline Vec3 roof_colour(std::uint64_t seed) {
  constexpr std::array kRoofs{Vec3(0.72F, 0.36F, 0.26F), Vec3(0.62F, 0.33F, 0.27F), Vec3(0.50F, 0.48F, 0.47F)};
  return one_of(kRoofs, seed, 11);
}
inline Vec3 leaf_colour(std::uint64_t seed) {
  constexpr std::array kLeaves{Vec3(0.30F, 0.50F, 0.20F), Vec3(0.38F, 0.55F, 0.24F), Vec3(0.24F, 0.42F, 0.22F)};
  return one_of(kLeaves, seed, 12);
}
inline Vec3 paint(std::uint32_t car) { return glm::pow(draw::car_paint(car), Vec3(1 / 2.2F)); }
/// Paint is white, for a car's own tint.
inline Vec3 part_colour(draw::CarPart part) {
  constexpr std::array kParts{Vec3(1), Vec3(0.25F), Vec3(0.15F), Vec3(0.6F), Vec3(1), Vec3(0.7F, 0.1F, 0.1F)};
  return kParts.at(static_cast<std::size_t>(part));
}

}  // namespace manzana::paper
