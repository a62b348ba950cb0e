#pragma once
/// The triangles of a glTF scene, transforms applied, z up.
#include <tiny_gltf.h>

#include "foliage/import/source_part.h"

namespace manzana::foliage {

/// A part for each primitive, where its node puts it; normals are computed, and texture coordinates 0, where the file
/// has none. Of the default scene, else of the first, else of all root nodes. Points and lines are left out, and so are
/// nodes whose scale is 0. Throws std::runtime_error naming the node, mesh or accessor: not finite, out of bounds,
/// nodes in a cycle or with two parents, too many triangles, none at all.
std::vector<SourcePart> gltf_triangles(const tinygltf::Model& model);

/// A node of that scene as the file has it.
struct GltfNode {
  int parent = -1;  ///< among those that are returned, before it
  std::string name;
  glm::dmat4 placement{1};  ///< in its parent's frame; y up
  int mesh = -1;
};
/// All nodes, but those whose scale is 0 and what is below them. Throws as gltf_triangles does.
std::vector<GltfNode> gltf_nodes(const tinygltf::Model& model);

/// The triangles of a mesh in its own frame, a part for each primitive that has some. Throws likewise.
std::vector<SourcePart> gltf_mesh(const tinygltf::Model& model, int mesh);

}  // namespace manzana::foliage
