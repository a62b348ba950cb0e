#pragma once
/// What a tile shows, in its frame, before it is written as glTF.
///   const TileContent content = tile_content(scene, tile, plants);
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <string>

#include "foliage/prepared_plant.h"
#include "scenegraph/export/tile_tree.h"

namespace manzana {

/// Triangles, counter-clockwise from outside. Colours are linear.
struct TileMesh {
  struct Vertex {
    Vec3 position, normal;
    Vec3 colour;
    std::uint32_t feature = 0;  ///< a row of TileContent::buildings
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Of a building; or of a block, for all of those in it that are too small to be shown one by one.
struct BuildingRow {
  std::string id, source, name, kind;  ///< source: kSourceId's value
  float height_m = 0;
};

struct TreeRow {
  Vec3 foot;
  glm::quat turn;                   ///< from the plant's frame
  Vec3 scale;                       ///< along the plant's axes
  float height_m = 0, crown_m = 0;  ///< the latter: diameter
  std::string source = {};
};

struct TileContent {
  TileMesh buildings_mesh, ground_mesh;
  std::vector<BuildingRow> buildings;
  std::map<std::uint16_t, std::vector<TreeRow>> trees;  ///< by TreeInstance::plant
  bool empty() const { return buildings_mesh.indices.empty() && ground_mesh.indices.empty() && trees.empty(); }
};

TileContent tile_content(const Scene& scene, const Tile& tile, std::span<const foliage::PreparedPlant> plants);

/// From a block's frame into a tile's.
struct Placement {
  Mat3d axes;
  Vec3d origin;
  Vec3d operator()(const Vec3d& p) const { return origin + axes * p; }
};
Placement placement(const BlockFrame& block, const BlockFrame& tile);

/// Vertices [first, last) of the layer, and indices [index_first, index_last).
struct MeshRow {
  std::uint32_t first = 0, last = 0, index_first = 0, index_last = 0;
};
MeshRow row_of(const MeshLayer& layer, std::uint32_t row);

/// Name, class and ids as the file says them, where attributes were asked for; else by number.
BuildingRow building_row(const Scene& scene, std::uint32_t row);

/// By what its file knows what is in a row of the layer; "" where that is not known.
std::string source_of(const Scene& scene, const LayerTable& table, std::uint32_t row);

/// As it is.
void append(TileMesh& mesh, const MeshLayer& layer, const MeshRow& row, const Placement& place, std::uint32_t feature);

}  // namespace manzana
