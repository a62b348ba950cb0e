#pragma once
/// From loose objects to the columns of a scene.
#include <span>
#include <vector>

#include "scenegraph/import/meshes.h"
#include "scenegraph/scene.h"

namespace manzana {

/// An object on its way into a MeshLayer: mesh in its block's frame, box in L; an empty mesh has an empty box.
struct MeshObject {
  CityMesh mesh;
  std::array<CityMesh, kMeshLevels> levels;
  culling::BoxD box;
  std::uint32_t block = 0;
  std::uint32_t attributes = 0;  ///< row
  culling::ClassMask kind = kSurface;
};
struct TreeObject {
  TreeInstance instance;
  culling::BoxD box;
  std::uint32_t attributes = 0;
  culling::ClassMask kind = kTrees;
};

/// Of the vertices as they are stored: floats in the block's frame, turned into L in double.
culling::BoxD bounds(const CityMesh& mesh, const BlockFrame& frame);
culling::BoxD bounds(const TreeInstance& tree, const BlockFrame& frame);

/// A piece of ground from plan into its block's frame: every vertex on the ellipsoid, then up by its height.
CityMesh lay(SurfacePiece piece, const Site& site);

/// What is known of a block before the tree is built.
class BlockContent {
 public:
  void add(const culling::BoxD& box);
  /// Encloses all boxes added; the point `ground` when there was none.
  culling::BlockVolume volume(const Vec2d& center, const Vec3d& ground) const;

 private:
  culling::BoxD box_;
  std::vector<culling::SphereD> balls_;
};

/// The objects of those numbers, in this order, those of a mesh layer joined; `from` is the number of objects[0].
/// Blocks as the objects have them by now.
MeshLayer make_layer(LayerTable table, std::span<const std::uint32_t> numbers, std::uint32_t from,
                     std::vector<MeshObject> objects);
TreeLayer make_layer(LayerTable table, std::span<const std::uint32_t> numbers, std::uint32_t from,
                     const std::vector<TreeObject>& objects);

}  // namespace manzana
