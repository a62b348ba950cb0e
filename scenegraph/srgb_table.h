#pragma once
/// sRGB bytes to linear light and back by tables, for pictures of many millions of them.
#include <array>
#include <cstdint>

#include "foliage/leaf_image.h"

namespace manzana {

class SrgbTable {
 public:
  SrgbTable() {
    for (std::size_t i = 0; i < linear_.size(); ++i) linear_[i] = foliage::linear_of_srgb(static_cast<std::uint8_t>(i));
    for (std::size_t i = 0; i < bytes_.size(); ++i) bytes_[i] = foliage::srgb_of_linear(static_cast<float>(i) / kLast);
  }
  float linear(std::uint8_t byte) const { return linear_[byte]; }
  /// Of [0, 1]; there and back is the same byte.
  std::uint8_t byte(float linear) const { return bytes_[static_cast<std::size_t>(linear * kLast + 0.5F)]; }

 private:
  static constexpr float kLast = 16383;
  std::array<float, 256> linear_;
  std::array<std::uint8_t, 16384> bytes_;
};

}  // namespace manzana
