#include <algorithm>
#include <numeric>

#include "foliage/leaf_points.h"

namespace manzana::foliage {
namespace {

std::uint32_t reversed_bits(std::uint32_t v) {
  std::uint32_t out = 0;
  for (int i = 0; i < 32; ++i, v >>= 1) out = (out << 1) | (v & 1U);
  return out;
}

int longest_side(std::span<const Vec3> positions, std::span<const std::uint32_t> rows) {
  Vec3 low = positions[rows[0]], high = low;
  for (const std::uint32_t i : rows) low = glm::min(low, positions[i]), high = glm::max(high, positions[i]);
  const Vec3 size = high - low;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

std::vector<Vec3> positions_of(const PointCloud& cloud) {
  std::vector<Vec3> positions;
  positions.reserve(cloud.size());
  for (const CloudPoint& point : cloud) positions.push_back(point.position);
  return positions;
}

CloudPoint mean_of(const PointCloud& cloud, std::span<const std::uint32_t> rows) {
  CloudPoint sum = cloud[rows[0]];
  sum.position = sum.normal = sum.colour = Vec3(0);
  sum.area = sum.shade = sum.square = 0;
  for (const std::uint32_t i : rows) {
    const CloudPoint& p = cloud[i];
    sum.area += p.area;
    sum.position += p.position * p.area;
    sum.normal += p.normal * p.area;
    sum.colour += p.colour * p.area;
    sum.shade += p.shade * p.area;
    sum.square += p.square * p.area;
  }
  for (Vec3* v : {&sum.position, &sum.normal, &sum.colour}) *v /= sum.area;
  sum.shade /= sum.area;
  sum.square /= sum.area;
  return sum;
}

double area(const PointCloud& cloud) {
  double sum = 0;
  for (const CloudPoint& point : cloud) sum += static_cast<double>(point.area);
  return sum;
}

PointCloud in_progressive_order(const PointCloud& cloud) {
  PointCloud out;
  out.reserve(cloud.size());
  for (const std::uint32_t i : progressive_order(positions_of(cloud))) out.push_back(cloud[i]);
  return out;
}

PointCloud joined(PointCloud a, const PointCloud& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const Vec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::span<std::uint32_t>> todo{order};
  while (!todo.empty()) {
    const std::span<std::uint32_t> set = todo.back();
    todo.pop_back();
    if (set.size() <= 4) {
      std::sort(set.begin(), set.end());
      continue;
    }
    const int axis = longest_side(positions, set);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(positions[a][axis], a) < std::pair(positions[b][axis], b);
    };
    const std::size_t half = (set.size() / 2 + 3) / 4 * 4;
    std::nth_element(set.begin(), set.begin() + static_cast<std::ptrdiff_t>(half), set.end(), before);
    todo.push_back(set.first(half));
    todo.push_back(set.subspan(half));
  }
  return order;
}

std::vector<std::uint32_t> progressive_order(std::span<const Vec3> positions) {
  const std::vector<std::uint32_t> spatial = spatial_order(positions);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
  keyed.reserve(spatial.size());
  for (std::uint64_t rank = 0; rank < spatial.size(); ++rank)
    keyed.emplace_back(reversed_bits(static_cast<std::uint32_t>((rank << 32) / spatial.size())), spatial[rank]);
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(keyed.size());
  for (const auto& [key, row] : keyed) order.push_back(row);
  return order;
}

PointCloud merged(const PointCloud& cloud, float large) {
  PointCloud out, small;
  for (const CloudPoint& point : cloud)
    if (point.area > 0) (point.area > large ? out : small).push_back(point);
  const std::vector<std::uint32_t> order = spatial_order(positions_of(small));
  for (std::size_t i = 0; i < order.size(); i += 4)
    out.push_back(mean_of(small, std::span(order).subspan(i, std::min<std::size_t>(4, order.size() - i))));
  return out;
}

std::vector<PointCloud> merged_levels(const PointCloud& finest) {
  constexpr std::size_t kFew = 8;
  constexpr std::size_t kMostLevels = 11;
  PointCloud leaves, others;
  for (const CloudPoint& p : finest)
    if (p.area > 0) (p.organ == Organ::leaf ? leaves : others).push_back(p);
  std::vector<PointCloud> levels;
  std::size_t count = leaves.size() + others.size();
  double large = count > 0 ? 2 * (area(leaves) + area(others)) / static_cast<double>(count) : 0;
  while (count > kFew && levels.size() < kMostLevels) {
    leaves = merged(leaves, static_cast<float>(large));
    if (!levels.empty()) others = merged(others, static_cast<float>(large / 4));
    levels.push_back(in_progressive_order(joined(leaves, others)));
    count = levels.back().size();
    large *= 4;
  }
  return levels;
}

}  // namespace manzana::foliage
