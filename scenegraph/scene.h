#pragma once
/// The scene: arrays and ids. An object (building, tree, piece of ground) is a row in the columns of its layer; blocks
/// and objects are stored in the order of the BqR-Tree, so a part of the tree is a run of blocks, and a run of every
/// kind of object.
///   Imported city = import_city("helsinki.osm.pbf");          // scenegraph/import/import.h
///   VisibleSets sets(city.scene);                             // scenegraph/visible.h, reserves once
///   find_visible(city.scene, view, Structure::bqr, sets);     // each frame
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "culling/bqr_tree.h"
#include "scenegraph/attributes.h"
#include "scenegraph/ground_photo.h"
#include "scenegraph/layer_table.h"
#include "scenegraph/local_frame.h"
#include "scenegraph/mesh.h"
#include "scenegraph/pictures.h"
#include "scenegraph/traffic.h"

namespace manzana {

/// Meshes of objects. Row i has the indices [index_first[i], index_first[i + 1]) of `mesh`, so a run of rows is one run
/// of indices.
struct MeshRows {
  StoredMesh mesh;
  std::vector<std::uint32_t> index_first;
};

/// Metres by which the points of a row may be off its level. Coarser ones have fewer triangles.
inline constexpr std::array<double, 3> kMeshLevelErrors{0.1, 0.4, 1.6};
inline constexpr std::size_t kMeshLevels = kMeshLevelErrors.size();

/// Objects with a mesh each, and their levels: a row that a level has nothing of is at that level as it is at the one
/// before.
struct MeshLayer : MeshRows {
  LayerTable table;
  std::array<MeshRows, kMeshLevels> levels;
};

/// What a tree is where no more is known.
enum class PlantKind : std::uint8_t { broadleaf, conifer, shrub };

/// What stands there; the drawing has a model for each. The first three: any other of that kind.
enum class PlantSpecies : std::uint8_t {
  broadleaf,
  conifer,
  shrub,
  oak,
  birch,
  poplar,
  pine,
  willow,
  lime,
  palm,
  apple,
  count
};
inline constexpr std::size_t kPlantSpecies = static_cast<std::size_t>(PlantSpecies::count);

constexpr PlantKind kind_of(PlantSpecies species) {
  if (species == PlantSpecies::conifer || species == PlantSpecies::pine) return PlantKind::conifer;
  return species == PlantSpecies::shrub ? PlantKind::shrub : PlantKind::broadleaf;
}
/// The species that stands for a kind.
constexpr PlantSpecies plain_species(PlantKind kind) {
  if (kind == PlantKind::conifer) return PlantSpecies::conifer;
  return kind == PlantKind::shrub ? PlantSpecies::shrub : PlantSpecies::broadleaf;
}

/// A tree. Position of its foot in its block's frame, metres.
struct TreeInstance {
  Vec3 position{0, 0, 0};
  float height_m = 10;
  float crown_radius_m = 3;
  float yaw = 0;  ///< radians about up
  std::uint32_t block = 0;
  std::uint16_t plant = 0;  ///< its model: a PlantSpecies, or from kPlantSpecies on those that an ecosystem brought
  std::uint8_t tint = 0;    ///< 0..255, a variation of colour
};

/// What neighbours hide of a tree, from eight sides: foliage/neighbours.h.
using TreeLeeway = std::array<std::uint32_t, 8>;

struct TreeLayer {
  LayerTable table;
  std::vector<TreeInstance> instances;  ///< a row a tree
  Column<TreeLeeway> leeway;            ///< a row a tree, or none: not known yet (scenegraph/tree_sites.h)
  std::uint64_t leeway_of = 0;          ///< which plants it is of
};

struct Scene {
  LocalFrame frame;
  culling::BqrTree tree;  ///< of all layers; its blocks and objects are in the scene's order
  std::vector<BlockFrame> blocks;
  MeshLayer buildings;
  MeshLayer surfaces;  ///< streets, greens, water, bridges
  TreeLayer trees;
  Traffic traffic;
  Attributes attributes;    ///< of objects of the tree; only if they were asked for
  Pictures pictures;        ///< what buildings wear
  GroundPhoto photo;        ///< laid over the ground; only if one was asked for
  culling::BoxD bounds;     ///< of all objects, in L
  std::string attribution;  ///< must be shown with every picture; empty for made-up data
};

}  // namespace manzana
