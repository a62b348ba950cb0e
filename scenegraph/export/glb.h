#pragma once
/// A tile's content as binary glTF 2.0 with the extensions of 3D Tiles 1.1: EXT_mesh_features for buildings,
/// EXT_mesh_gpu_instancing and EXT_instance_features for trees, EXT_structural_metadata for both. Two files, since
/// CesiumJS picks from one table of a file only.
///   const EncodedTile city = encode_city(content, "(c) OpenStreetMap contributors");
#include <string>

#include "culling/volumes.h"
#include "scenegraph/export/plant_model.h"

namespace manzana {

struct EncodedTile {
  std::string glb;    ///< empty: there is nothing to show
  culling::BoxD box;  ///< in the tile's frame: of every vertex of every instance, with room for what floats round
};

struct TreeModel {
  TileMesh mesh;
  std::string species;
};
using TreeModels = std::map<std::uint16_t, TreeModel>;  ///< by TreeInstance::plant

EncodedTile encode_city(const TileContent& content, const std::string& attribution);
/// `models`: of each plant of content.trees, none without triangles.
EncodedTile encode_trees(const TileContent& content, const TreeModels& models, const std::string& attribution);

}  // namespace manzana
