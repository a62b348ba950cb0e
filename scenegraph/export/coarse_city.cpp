#include "scenegraph/export/coarse_city.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <span>

#include "foliage/leaf_image.h"

namespace manzana {
namespace {

/// Upright, about a direction of its own in plan. In the block's frame, metres.
struct UprightBox {
  Vec2d along{1, 0};
  Vec3d min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};

  Vec3d inside(const Vec3d& p) const {  // (along, across, up)
    return {glm::dot(Vec2d(p), along), glm::dot(Vec2d(p), Vec2d(-along.y, along.x)), p.z};
  }
  Vec3d outside(const Vec3d& q) const { return {along * q.x + Vec2d(-along.y, along.x) * q.y, q.z}; }
  void add(const Vec3d& p) {
    min = glm::min(min, inside(p));
    max = glm::max(max, inside(p));
  }
  Vec3d corner(unsigned i) const {
    return outside({(i & 1U) != 0 ? max.x : min.x, (i & 2U) != 0 ? max.y : min.y, (i & 4U) != 0 ? max.z : min.z});
  }
  double area() const { return (max.x - min.x) * (max.y - min.y); }
  double height() const { return max.z - min.z; }
};

struct Building {
  std::span<const CityVertex> vertices;
  MeshRow row;
  UprightBox box;
};

Vec3 linear_colour(const CityVertex& v) {
  return foliage::linear_of_rgb((v.colour & 255U) << 16 | (v.colour & 0xff00U) | (v.colour >> 16 & 255U));
}

/// The direction of most wall: angles count four times, so that walls at right angles agree.
Vec2d direction_of(const MeshLayer& layer, const MeshRow& row) {
  Vec2d sum(0);
  for (std::uint32_t i = row.index_first; i + 2 < row.index_last; i += 3) {
    const auto at = [&](std::uint32_t k) { return Vec3d(layer.mesh.vertices[layer.mesh.indices[i + k]].position); };
    const Vec3d normal = glm::cross(at(1) - at(0), at(2) - at(0));
    const double angle = 4 * std::atan2(normal.y, normal.x);
    sum += glm::length(Vec2d(normal)) * Vec2d(std::cos(angle), std::sin(angle));
  }
  const double angle = std::atan2(sum.y, sum.x) / 4;
  return {std::cos(angle), std::sin(angle)};
}

Building building_of(const MeshLayer& layer, std::uint32_t index) {
  const MeshRow row = row_of(layer, index);
  Building building{layer.mesh.vertices.items().subspan(row.first, row.last - row.first), row, {}};
  building.box.along = direction_of(layer, row);
  for (const CityVertex& v : building.vertices) building.box.add(Vec3d(v.position));
  return building;
}

/// How far vertices are from the box's faces at most, and its corners from the nearest vertex.
double error_of(const UprightBox& box, std::span<const CityVertex> vertices) {
  double worst = 0;
  std::array<double, 8> nearest;
  nearest.fill(std::numeric_limits<double>::infinity());
  for (const CityVertex& v : vertices) {
    const Vec3d p(v.position), low = box.inside(p) - box.min, high = box.max - box.inside(p);
    worst = std::max(worst, std::min({low.x, low.y, high.x, high.y, high.z}));
    for (unsigned i = 0; i < 8; ++i) nearest[i] = std::min(nearest[i], glm::distance(p, box.corner(i)));
  }
  return std::max(worst, *std::ranges::max_element(nearest));
}

struct Paint {
  Vec3 wall{0.5F}, roof{0.4F};
};

/// Means over the vertices.
Paint paint_of(std::span<const CityVertex> vertices) {
  Vec3 sums[2]{Vec3(0), Vec3(0)};
  float counts[2]{0, 0};
  for (const CityVertex& v : vertices) {
    const int which = glm::unpackSnorm3x10_1x2(v.normal).z > 0.35F ? 1 : 0;
    sums[which] += linear_colour(v);
    counts[which] += 1;
  }
  const Vec3 all = (sums[0] + sums[1]) / std::max(1.0F, counts[0] + counts[1]);
  return {counts[0] > 0 ? sums[0] / counts[0] : all, counts[1] > 0 ? sums[1] / counts[1] : all};
}

/// Walls and a top; nobody sees it from below.
void append_box(TileMesh& mesh, const UprightBox& box, const Paint& paint, const Placement& place,
                std::uint32_t feature) {
  constexpr std::array<std::array<unsigned, 4>, 5> kFaces{
      {{1, 3, 7, 5}, {2, 0, 4, 6}, {3, 2, 6, 7}, {0, 1, 5, 4}, {4, 5, 7, 6}}};
  const std::array<Vec3d, 5> normals{Vec3d(1, 0, 0), Vec3d(-1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(0, 0, 1)};
  for (std::size_t f = 0; f < kFaces.size(); ++f) {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    const Vec3 normal(place.axes * box.outside(normals[f]));
    for (const unsigned corner : kFaces[f])
      mesh.vertices.push_back({Vec3(place(box.corner(corner))), normal, f == 4 ? paint.roof : paint.wall, feature});
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + i);
  }
}

/// The buildings of a block that are too low to be told apart.
struct Low {
  UprightBox box;
  Paint paint{Vec3(0), Vec3(0)};
  double volume = 0, area = 0;
  float count = 0;

  void add(const UprightBox& other, const Paint& one) {
    if (count == 0) box.along = other.along;
    for (unsigned i = 0; i < 8; ++i) box.add(other.corner(i));
    volume += other.area() * other.height();
    area += other.area();
    paint.wall += one.wall;
    paint.roof += one.roof;
    count += 1;
  }
};

}  // namespace

void append_coarse_buildings(TileContent& content, const Scene& scene, std::uint32_t block, const Placement& place,
                             double error_m) {
  const MeshLayer& layer = scene.buildings;
  const auto [first, last] = layer.table.rows(scene.tree.block_objects[block]);
  std::vector<Building> buildings;
  for (std::uint32_t i = first; i < last; ++i) buildings.push_back(building_of(layer, i));
  double ground = std::numeric_limits<double>::infinity();
  for (const Building& building : buildings) ground = std::min(ground, building.box.min.z);
  Low low;
  for (std::uint32_t i = first; i < last; ++i) {
    const auto& [vertices, row, box] = buildings[i - first];
    if (box.max.z - ground <= error_m) {
      low.add(box, paint_of(vertices));
      continue;
    }
    const auto feature = static_cast<std::uint32_t>(content.buildings.size());
    content.buildings.push_back(building_row(scene, i));
    if (error_of(box, vertices) <= error_m)
      append_box(content.buildings_mesh, box, paint_of(vertices), place, feature);
    else
      append(content.buildings_mesh, layer, row, place, feature);
  }
  if (low.count == 0) return;
  low.box.min.z = ground;
  low.box.max.z = ground + low.volume / std::max(low.box.area(), low.area);
  append_box(content.buildings_mesh, low.box, {low.paint.wall / low.count, low.paint.roof / low.count}, place,
             static_cast<std::uint32_t>(content.buildings.size()));
  content.buildings.push_back(
      {"block " + std::to_string(block), "", "", "block", static_cast<float>(low.box.height())});
}

void append_coarse_ground(TileMesh& mesh, const Scene& scene, std::uint32_t block, const Placement& place,
                          double error_m) {
  const MeshLayer& layer = scene.surfaces;
  const auto [first, last] = layer.table.rows(scene.tree.block_objects[block]);
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = first; i < last; ++i) {
    const MeshRow row = row_of(layer, i);
    const std::size_t from = mesh.vertices.size(), first_index = mesh.indices.size();
    append(mesh, layer, row, place, 0);
    double area = 0;
    for (std::size_t k = first_index; k + 2 < mesh.indices.size(); k += 3) {
      const auto at = [&](std::size_t j) { return mesh.vertices[mesh.indices[k + j]].position; };
      area += static_cast<double>(glm::length(glm::cross(at(1) - at(0), at(2) - at(0)))) / 2;
    }
    indices.clear();
    if (area > error_m * error_m) {
      for (std::size_t k = first_index; k < mesh.indices.size(); ++k)
        indices.push_back(mesh.indices[k] - static_cast<std::uint32_t>(from));
      const float* positions = &mesh.vertices[from].position.x;
      const std::size_t count = mesh.vertices.size() - from;
      const float scale = meshopt_simplifyScale(positions, count, sizeof(TileMesh::Vertex));
      indices.resize(meshopt_simplify(indices.data(), indices.data(), indices.size(), positions, count,
                                      sizeof(TileMesh::Vertex), 0, static_cast<float>(error_m) / scale, 0, nullptr));
    }
    mesh.indices.resize(first_index);
    for (const std::uint32_t k : indices) mesh.indices.push_back(static_cast<std::uint32_t>(from) + k);
  }
}

}  // namespace manzana
