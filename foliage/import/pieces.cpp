#include "foliage/import/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "foliage/sets.h"

namespace manzana::foliage {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (const std::int64_t v : c) h = (h ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15ULL, h ^= h >> 32;
    return h;
  }
};

float extent(std::span<const Vec3> positions) {
  Vec3 low(positions[0]), high(low);
  for (const Vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
  return glm::length(high - low);
}

}  // namespace

std::vector<std::uint32_t> joined_by_place(std::span<const Vec3> positions) {
  if (positions.empty()) return {};
  Sets sets(positions.size());
  const double side = std::max(static_cast<double>(extent(positions)), 1e-30) * 1e-5;
  // Neighbours that one grid parts the other one, half a cell off, joins.
  for (const double shift : {0.0, 0.5}) {
    std::unordered_map<Cell, std::uint32_t, CellHash> first;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
      Cell cell;
      for (std::size_t k = 0; k < 3; ++k)
        cell[k] = static_cast<std::int64_t>(std::floor(
            static_cast<double>(positions[i][static_cast<int>(k)] - positions[0][static_cast<int>(k)]) / side + shift));
      sets.join(first.try_emplace(cell, i).first->second, i);
    }
  }
  std::vector<std::uint32_t> out(positions.size());
  for (std::uint32_t i = 0; i < out.size(); ++i) out[i] = sets.find(i);
  return out;
}

Pieces connected_pieces(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> key) {
  const std::size_t count = corners.size() / 3;
  Sets sets(count);
  std::unordered_map<std::uint64_t, std::uint32_t> first_at;  // a corner and a key: a triangle there
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      sets.join(first_at.try_emplace(std::uint64_t{corners[3 * t + k]} << 32 | key[t], t).first->second, t);
  std::vector<std::uint32_t> number(count);
  Pieces out;
  out.first.push_back(0);
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::uint32_t root = sets.find(t);
    if (root == t) number[t] = static_cast<std::uint32_t>(sizes.size()), sizes.push_back(0);
    number[t] = number[root];
    ++sizes[number[t]];
  }
  for (const std::uint32_t size : sizes) out.first.push_back(out.first.back() + size);
  out.triangles.resize(count);
  std::vector<std::uint32_t> place(out.first.begin(), out.first.end() - 1);
  for (std::uint32_t t = 0; t < count; ++t) out.triangles[place[number[t]]++] = t;
  return out;
}

}  // namespace manzana::foliage
