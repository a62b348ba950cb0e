#include "scenegraph/import/terrain_heights.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/import/plan_geometry.h"

namespace manzana {
namespace {

constexpr double kMostCells = 64;  // a side that one triangle may cover

double twice_area(const TerrainHeights::Triangle& t) { return plan::turn(Vec2d(t[0]), Vec2d(t[1]), Vec2d(t[2])); }

double extent(const TerrainHeights::Triangle& t) {
  const Vec2d size = glm::max(glm::max(Vec2d(t[0]), Vec2d(t[1])), Vec2d(t[2])) -
                     glm::min(glm::min(Vec2d(t[0]), Vec2d(t[1])), Vec2d(t[2]));
  return std::max(size.x, size.y);
}

std::optional<double> height(const TerrainHeights::Triangle& t, const Vec2d& p) {
  const double whole = twice_area(t);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = plan::turn(Vec2d(t[(k + 1) % 3]), Vec2d(t[(k + 2) % 3]), p) / whole;
    if (!(share >= -1e-9)) return {};
    sum += share * t[k].z;
  }
  return sum;
}

}  // namespace

TerrainHeights::TerrainHeights(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  std::erase_if(triangles_, [](const Triangle& t) { return !(std::abs(twice_area(t)) > 1e-9) || !(extent(t) < 1e6); });
  double sum = 0, most = 0;
  for (const Triangle& t : triangles_) sum += extent(t), most = std::max(most, extent(t));
  if (!triangles_.empty()) size_ = std::max({1e-3, sum / static_cast<double>(triangles_.size()), most / kMostCells});
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const Vec2d low = glm::min(glm::min(Vec2d(t[0]), Vec2d(t[1])), Vec2d(t[2]));
    const Vec2d high = glm::max(glm::max(Vec2d(t[0]), Vec2d(t[1])), Vec2d(t[2]));
    for (double x = std::floor(low.x / size_); x <= std::floor(high.x / size_); ++x)
      for (double y = std::floor(low.y / size_); y <= std::floor(high.y / size_); ++y)
        cells_[cell(Vec2d(x + 0.5, y + 0.5) * size_)].push_back(i);
  }
}

std::uint64_t TerrainHeights::cell(const Vec2d& p) const {
  const auto x = static_cast<std::int64_t>(std::floor(p.x / size_)),
             y = static_cast<std::int64_t>(std::floor(p.y / size_));
  return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
}

std::optional<double> TerrainHeights::at(const Vec2d& p) const {
  if (!(glm::length(p) < 1e7)) return {};
  const auto found = cells_.find(cell(p));
  std::optional<double> best;
  if (found == cells_.end()) return best;
  for (const std::uint32_t i : found->second)
    if (const auto h = height(triangles_[i], p)) best = std::max(best.value_or(*h), *h);
  return best;
}

}  // namespace manzana
