#include "apps/culling_benchmark/paper_geometry.h"

#include <map>

namespace manzana::paper {
namespace {

/// Indices count from `base`, the first of those corners.
void append(Geometry& geometry, std::span<const Corner> corners, std::span<const std::uint32_t> indices,
            std::uint32_t base) {
  const auto here = static_cast<std::uint32_t>(geometry.corners.size());
  geometry.corners.insert(geometry.corners.end(), corners.begin(), corners.end());
  for (const std::uint32_t index : indices) geometry.indices.push_back(index - base + here);
  geometry.first_corner.push_back(static_cast<std::uint32_t>(geometry.corners.size()));
  geometry.first_index.push_back(static_cast<std::uint32_t>(geometry.indices.size()));
}

}  // namespace

void append(Geometry& geometry, const Mesh& mesh) { append(geometry, mesh.corners, mesh.indices, 0); }

Geometry make_geometry(const baselines::City& city) {
  Geometry geometry;
  std::map<std::uint32_t, Mesh> cars;  // by triangles
  for (std::uint32_t row = 0; row < city.objects(); ++row) {
    const std::uint32_t n = city.triangles[row];
    if (n == 0 || city.kinds[row] != baselines::ObjectKind::car) {
      append(geometry, make_object(city.kinds[row], city.boxes[row], n, row));
      continue;
    }
    if (!cars.contains(n)) cars.emplace(n, make_car(n));
    append(geometry, parked_car(cars.at(n), city.boxes[row], row));
  }
  return geometry;
}

Geometry arranged(const Geometry& rows, std::span<const std::uint32_t> order) {
  if (order.empty()) return rows;
  Geometry own;
  own.corners.reserve(rows.corners.size());
  own.indices.reserve(rows.indices.size());
  for (const std::uint32_t row : order) {
    const std::uint32_t corner = rows.first_corner[row], index = rows.first_index[row];
    append(own, std::span(rows.corners).subspan(corner, rows.first_corner[row + 1] - corner),
           std::span(rows.indices).subspan(index, rows.first_index[row + 1] - index), corner);
  }
  return own;
}

}  // namespace manzana::paper
