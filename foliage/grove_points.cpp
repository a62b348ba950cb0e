#include "foliage/grove_points.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "foliage/branch_points.h"
#include "foliage/grove.h"
#include "foliage/leaf_points.h"
#include "foliage/random.h"
#include "foliage/square_picture.h"

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kBranchPoints = 2 * kPlantPoints, kMostPoints = 8 * kPlantPoints, kSides = 16;

/// The finest level that has no more.
Run level_of(const PreparedPlant& plant) {
  std::size_t i = 0;
  while (i + 1 < plant.point_levels.size() && plant.point_levels[i].points.size() > kMostPoints) ++i;
  return plant.point_levels[i].points;
}

std::vector<std::uint32_t> pixels_of(const PreparedPlant& plant, std::span<const LeafPoint> surface) {
  std::vector<std::uint32_t> pixels(surface.size());
  SquarePicture picture;
  for (std::uint32_t side = 0; side < kSides; ++side)
    for (const float up : {0.0F, 0.5F, 1.0F}) {
      const float azimuth = 2 * std::numbers::pi_v<float> * static_cast<float>(side) / kSides;
      picture.count(SquareSight(plant, up, azimuth).squares(surface), pixels);
    }
  return pixels;
}

std::vector<Vec3> positions_of(std::span<const LeafPoint> points) {
  std::vector<Vec3> positions;
  for (const LeafPoint& point : points) positions.push_back(point.position);
  return positions;
}

/// Those that stand for more of it are taken again, anywhere about their squares.
LeafPoint taken(const LeafPoint& point, std::uint64_t seed) {
  Random random(seed);
  const float half = 0.5F * std::sqrt(point.area);
  LeafPoint out = point;
  out.position += Vec3(random.spread(half), random.spread(half), random.spread(half));
  return out;
}

}  // namespace

std::vector<LeafPoint> grove_surface(const PreparedPlant& plant) {
  constexpr std::uint32_t kNormal = glsl::kGroveLeaf - 1;  // without the branch's level
  std::vector<LeafPoint> surface = branch_points(plant, kBranchPoints);
  for (LeafPoint& point : surface) point.normal &= kNormal;
  if (plant.point_levels.empty()) return surface;
  const Run level = level_of(plant);
  for (std::uint32_t row = level.first; row < level.last; ++row) {
    surface.push_back(plant.points[row]);
    surface.back().normal = (surface.back().normal & kNormal) | glsl::kGroveLeaf;
  }
  return surface;
}

std::vector<LeafPoint> grove_points(const PreparedPlant& plant, std::span<const LeafPoint> surface) {
  const std::vector<std::uint32_t> pixels = pixels_of(plant, surface);
  const double all = std::accumulate(pixels.begin(), pixels.end(), 0.0), step = all / kPlantPoints;
  if (!(all > 0)) return {};
  float area = 0;
  std::vector<LeafPoint> points;
  double seen = 0;
  for (const std::uint32_t row : spatial_order(positions_of(surface))) {
    area += surface[row].area;
    seen += pixels[row];
    while (points.size() < kPlantPoints && (static_cast<double>(points.size()) + 0.5) * step < seen)
      points.push_back(taken(surface[row], points.size()));
  }
  std::vector<LeafPoint> ordered;
  for (const std::uint32_t row : progressive_order(positions_of(points))) {
    ordered.push_back(points[row]);
    ordered.back().area = area / kPlantPoints;
  }
  return ordered;
}

}  // namespace manzana::foliage
