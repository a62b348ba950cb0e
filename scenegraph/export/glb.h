#pragma once
/// A tile's content as binary glTF 2.0 with the extensions of 3D Tiles 1.1: EXT_mesh_features for buildings,
/// EXT_mesh_gpu_instancing and EXT_instance_features for trees, EXT_structural_metadata for both. Two files, since
/// CesiumJS picks from one table of a file only.
///   const EncodedTile city = encode_city(content, "(c) OpenStreetMap contributors");
#include <memory>
#include <string>

#include "culling/volumes.h"
#include "scenegraph/export/plant_model.h"

namespace manzana {

struct EncodedTile {
  std::string glb;    ///< empty: there is nothing to show
  culling::BoxD box;  ///< in the tile's frame: of every vertex of every instance, with room for what floats round
};

struct SharedModel;

/// A model in a file of its own, for all tiles that show it; or, without one, in each tile.
struct TreeModel {
  TileMesh mesh;
  std::string species;
  std::string uri = {};                           ///< of `bytes`, as seen from a tile; empty: there is no such file
  std::string bytes = {};                         ///< its file
  std::shared_ptr<const SharedModel> parts = {};  ///< what lies where in it
};
using TreeModels = std::map<std::uint16_t, TreeModel>;  ///< by TreeInstance::plant

EncodedTile encode_city(const TileContent& content, const std::string& attribution);
/// To be written to the file that `uri` names.
TreeModel share(TreeModel model, const std::string& uri);

/// `models`: of each plant of content.trees, none without triangles.
EncodedTile encode_trees(const TileContent& content, const TreeModels& models, const std::string& attribution);

}  // namespace manzana
