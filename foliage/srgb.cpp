// Powers are slow, and pictures have millions of texels: both ways are looked up, with the same answers to the bit.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "foliage/leaf_image.h"

namespace manzana::foliage {
namespace {

float linear_of(int byte) {  // IEC 61966-2-1
  const float v = static_cast<float>(byte) / 255;
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

int byte_of(float linear) {
  const float s = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
  return static_cast<int>(std::lround(s * 255));
}

/// The least of [0, 1] that comes to the byte: floats of one sign are in the order of their bits.
float least_of(int byte) {
  std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0F);
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (byte_of(std::bit_cast<float>(middle)) < byte)
      low = middle + 1;
    else
      high = middle;
  }
  return std::bit_cast<float>(low);
}

struct Tables {
  static constexpr float kSteps = 4096;  // so many that a step has about one byte
  LinearBytes linear{};
  std::array<float, 256> least{};
  std::array<std::uint8_t, 4097> from{};
  Tables() {
    for (int i = 0; i < 256; ++i) {
      linear[static_cast<std::size_t>(i)] = linear_of(i);
      least[static_cast<std::size_t>(i)] = least_of(i);
    }
    for (std::size_t i = 0; i < from.size(); ++i)
      from[i] = static_cast<std::uint8_t>(byte_of(static_cast<float>(i) / kSteps));
  }
};

const Tables& tables() {
  static const Tables made;
  return made;
}

}  // namespace

const LinearBytes& linear_of_srgb() { return tables().linear; }
float linear_of_srgb(std::uint8_t value) { return tables().linear[value]; }

std::uint8_t srgb_of_linear(float value) {
  const Tables& table = tables();
  const float v = value > 0 ? std::min(value, 1.0F) : 0.0F;  // 0 for what is no number
  std::size_t byte = table.from[static_cast<std::size_t>(v * Tables::kSteps)];
  while (byte < 255 && v >= table.least[byte + 1]) ++byte;
  return static_cast<std::uint8_t>(byte);
}

Vec3 linear_of_rgb(std::uint32_t rgb) {
  return {linear_of_srgb(static_cast<std::uint8_t>(rgb >> 16)), linear_of_srgb(static_cast<std::uint8_t>(rgb >> 8)),
          linear_of_srgb(static_cast<std::uint8_t>(rgb))};
}

}  // namespace manzana::foliage
