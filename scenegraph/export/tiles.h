#pragma once
/// A scene as a 3D Tiles 1.1 tileset, for CesiumJS, Cesium for Unreal, deck.gl and others.
///   write_tiles(city.scene, plants, "helsinki-tiles", tell);        // then open helsinki-tiles/tileset.json
/// The tree of tiles is the BqR-Tree: a node is a tile bounded by a sphere, a block a leaf bounded by a box. A leaf
/// holds all of its block. A node holds the same with less detail, by one measure: so many metres may be wrong, which
/// is the tile's geometric error (tile_tree.h), as error in pixels / focal length in pixels * distance is when drawing.
/// A tile's frame is local, z along the ellipsoid's up at its middle; only the root knows the Earth's centre, in
/// double.
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "foliage/prepared_plant.h"
#include "scenegraph/scene.h"

namespace manzana {

struct TilesWritten {
  std::size_t tiles = 0, files = 0, trees = 0, buildings = 0;  ///< trees and buildings: of the leaves
  std::uint64_t bytes = 0;
};

/// `plants`: by TreeInstance::plant; one that is empty stands nowhere. The folder is made, or empty; it is there whole
/// or not at all. Throws std::runtime_error ("FOLDER: what").
TilesWritten write_tiles(const Scene& scene, std::span<const foliage::PreparedPlant> plants,
                         const std::filesystem::path& folder,
                         const std::function<void(std::string_view stage, double fraction)>& progress = {});

}  // namespace manzana
