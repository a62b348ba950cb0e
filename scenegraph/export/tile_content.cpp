#include "scenegraph/export/tile_content.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/quaternion.hpp>

#include "foliage/leaf_image.h"
#include "scenegraph/export/coarse_city.h"

namespace manzana {
namespace {

void append_all(TileContent& content, const Scene& scene, std::uint32_t block, const Placement& place) {
  const culling::ObjectRun objects = scene.tree.block_objects[block];
  const culling::ObjectRun buildings = scene.buildings.table.rows(objects), ground = scene.surfaces.table.rows(objects);
  for (std::uint32_t i = buildings.first; i < buildings.last; ++i) {
    const auto feature = static_cast<std::uint32_t>(content.buildings.size());
    content.buildings.push_back(building_row(scene, i));
    append(content.buildings_mesh, scene.buildings, row_of(scene.buildings, i), place, feature);
  }
  for (std::uint32_t i = ground.first; i < ground.last; ++i)
    append(content.ground_mesh, scene.surfaces, row_of(scene.surfaces, i), place, 0);
}

/// Those that are higher than what may be wrong.
void append_trees(TileContent& content, const Scene& scene, std::uint32_t block, const Placement& place, double error_m,
                  std::span<const foliage::PreparedPlant> plants) {
  const auto [first, last] = scene.trees.table.rows(scene.tree.block_objects[block]);
  for (std::uint32_t i = first; i < last; ++i) {
    const TreeInstance& tree = scene.trees.instances[i];
    if (static_cast<double>(tree.height_m) <= error_m) continue;
    const foliage::PreparedPlant& plant = plants[tree.plant];
    const float across = tree.crown_radius_m / plant.crown_radius_m, up = tree.height_m / plant.height_m;
    const glm::dquat turn = glm::quat_cast(place.axes) * glm::angleAxis(static_cast<double>(tree.yaw), Vec3d(0, 0, 1));
    content.trees[tree.plant].push_back({.foot = Vec3(place(Vec3d(tree.position))),
                                         .turn = glm::quat(glm::normalize(turn)),
                                         .scale = {across, across, up},
                                         .height_m = tree.height_m,
                                         .crown_m = 2 * tree.crown_radius_m,
                                         .source = source_of(scene, scene.trees.table, i)});
  }
}

/// Vertices that no triangle has any more go.
void compact(TileMesh& mesh) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFF;
  std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
  std::vector<TileMesh::Vertex> used;
  for (std::uint32_t& i : mesh.indices) {
    if (place[i] == kUnused) {
      place[i] = static_cast<std::uint32_t>(used.size());
      used.push_back(mesh.vertices[i]);
    }
    i = place[i];
  }
  mesh.vertices = std::move(used);
}

}  // namespace

Placement placement(const BlockFrame& block, const BlockFrame& tile) {
  return {glm::transpose(tile.axes) * block.axes, tile.to_block(block.origin)};
}

MeshRow row_of(const MeshLayer& layer, std::uint32_t row) {
  const std::uint32_t first = layer.index_first[row], last = layer.index_first[row + 1];
  if (first == last) return {0, 0, first, last};
  const auto begin = layer.mesh.indices.begin();
  const auto [low, high] = std::minmax_element(begin + first, begin + last);
  return {*low, *high + 1, first, last};
}

void append(TileMesh& mesh, const MeshLayer& layer, const MeshRow& row, const Placement& place, std::uint32_t feature) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = row.first; i < row.last; ++i) {
    const CityVertex& v = layer.mesh.vertices[i];
    const Vec3d normal = glm::normalize(Vec3d(glm::unpackSnorm3x10_1x2(v.normal)));
    const std::uint32_t rgb = (v.colour & 255U) << 16 | (v.colour & 0xff00U) | (v.colour >> 16 & 255U);
    mesh.vertices.push_back(
        {Vec3(place(Vec3d(v.position))), Vec3(place.axes * normal), foliage::linear_of_rgb(rgb), feature});
  }
  for (std::uint32_t i = row.index_first; i < row.index_last; ++i)
    mesh.indices.push_back(base + layer.mesh.indices[i] - row.first);
}

namespace {

/// The tree's object that is the layer's row.
std::uint32_t object_of(const LayerTable& table, std::uint32_t row) {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(table.row_first, row) - table.row_first.begin() - 1);
}

}  // namespace

BuildingRow building_row(const Scene& scene, std::uint32_t row) {
  const MeshRow mesh = row_of(scene.buildings, row);
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (std::uint32_t i = mesh.first; i < mesh.last; ++i) {
    low = std::min(low, scene.buildings.mesh.vertices[i].position.z);
    high = std::max(high, scene.buildings.mesh.vertices[i].position.z);
  }
  const AttributeRow said = scene.attributes.of(object_of(scene.buildings.table, row));
  const auto text = [&](std::string_view name, std::string otherwise) {
    const auto found = said.find(name);
    return found && *found != "yes" ? std::string(*found) : otherwise;
  };
  return {text("id", "building " + std::to_string(row)), std::string(said.source()), text("name", ""),
          text("building", "building"), high - low};
}

std::string source_of(const Scene& scene, const LayerTable& table, std::uint32_t row) {
  return std::string(scene.attributes.of(object_of(table, row)).source());
}

TileContent tile_content(const Scene& scene, const Tile& tile, std::span<const foliage::PreparedPlant> plants) {
  TileContent content;
  for (const std::uint32_t block : tile.blocks) {
    const Placement place = placement(scene.blocks[block], tile.frame);
    if (tile.leaf) {
      append_all(content, scene, block, place);
    } else {
      append_coarse_buildings(content, scene, block, place, tile.error_m);
      append_coarse_ground(content.ground_mesh, scene, block, place, tile.error_m);
    }
    append_trees(content, scene, block, place, tile.error_m, plants);
  }
  compact(content.ground_mesh);
  return content;
}

}  // namespace manzana
