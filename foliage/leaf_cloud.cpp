#include "foliage/leaf_cloud.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "foliage/leaf_quads.h"
#include "foliage/random.h"

namespace manzana::foliage {
namespace {

/// 0 .. count - 1, by hash.
std::vector<std::uint32_t> random_order(std::uint32_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(hash(seed, a), a) < std::pair(hash(seed, b), b);
  });
  return order;
}

void append_cell(const LeafQuads& source, const std::vector<std::uint32_t>& leaves, PreparedPlant& ready) {
  LeafCell cell{};
  cell.axes = Mat3(1);
  cell.quads.first = static_cast<std::uint32_t>(ready.leaves.size());
  Vec3 low(3e38F), high(-3e38F);
  for (const std::uint32_t leaf : leaves) {
    for (std::uint32_t q = source.leaves[leaf].first; q < source.leaves[leaf].last; ++q) {
      for (const auto& corner : source.quads[q].corners)
        low = glm::min(low, corner.position), high = glm::max(high, corner.position);
      ready.leaves.push_back(source.quads[q]);
    }
  }
  cell.quads.last = static_cast<std::uint32_t>(ready.leaves.size());
  cell.centre = 0.5F * (low + high);
  cell.half = 0.5F * (high - low) * 1.00001F + Vec3(1e-5F);
  ready.cells.push_back(cell);
}

float area_of(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5F * glm::length(glm::cross(b - a, c - a)); }

void append_points(const PlantQuad& quad, PreparedPlant& ready) {
  const auto& c = quad.corners;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto& third = c[i < 2 ? 1 : 3].position;
    const float area = area_of(c[0].position, third, c[2].position);
    const Vec3 middle = (c[0].position + third + c[2].position) / 3.0F;
    LeafPoint point{};
    point.position = glm::mix(middle, c[i % 2 == 0 ? 0 : 2].position, 0.3F);
    point.area = 0.25F * area;
    point.normal = quad.normals[0];
    point.colour = 0xff3f7f3fU;
    point.shade = static_cast<float>(quad.shades[0]) / 255;
    ready.points.push_back(point);
    if (i % 2 == 0) ready.leaf_area_m2 += area;
  }
}

}  // namespace

void prepare_leaves(const Plant& plant, const PrepareOptions& options, PreparedPlant& ready) {
  const LeafQuads source = leaf_quads(plant);
  if (source.quads.empty()) return;
  append_cell(source, random_order(static_cast<std::uint32_t>(source.leaves.size()), options.seed), ready);
  ready.shuffled = random_order(static_cast<std::uint32_t>(ready.leaves.size()), options.seed + 1);
  for (const std::uint32_t quad : ready.shuffled) append_points(ready.leaves[quad], ready);
  const Run all{0, static_cast<std::uint32_t>(ready.points.size())};
  ready.point_levels.push_back({all, 0.5F * ready.leaf_area_m2});
  for (std::size_t i = 0; i < ready.leaf_scale.size(); ++i)
    ready.leaf_scale[i] = std::exp2(0.25F * static_cast<float>(i));
}

}  // namespace manzana::foliage
