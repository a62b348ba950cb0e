#include "scenegraph/mesh.h"

#include <algorithm>
#include <cmath>

namespace manzana {

std::uint32_t pack_normal(const Vec3& unit) {
  const auto field = [](float v) {  // GL 4.5, 2.3.5.1: f = max(c / 511, -1)
    return static_cast<std::uint32_t>(std::lround(std::clamp(v, -1.0F, 1.0F) * 511.0F)) & 1023U;
  };
  return field(unit.x) | field(unit.y) << 10 | field(unit.z) << 20;
}

}  // namespace manzana
