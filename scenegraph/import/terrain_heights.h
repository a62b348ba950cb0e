#pragma once
/// Heights of a terrain of triangles, asked for by place.
///   TerrainHeights terrain(triangles);
///   std::optional<double> h = terrain.at({x, y});
#include <array>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "culling/vec.h"

namespace manzana {

class TerrainHeights {
 public:
  using Triangle = std::array<Vec3d, 3>;  ///< (x, y in plan, height)
  TerrainHeights() = default;
  /// Triangles that stand upright, or are not finite, hold nothing.
  explicit TerrainHeights(std::vector<Triangle> triangles);
  /// None beside the terrain; of several triangles there the highest.
  std::optional<double> at(const Vec2d& p) const;

 private:
  std::uint64_t cell(const Vec2d& p) const;
  std::vector<Triangle> triangles_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  double size_ = 1;
};

}  // namespace manzana
