#pragma once
/// The triangles of a glTF scene, transforms applied, z up.
#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "culling/vec.h"

namespace manzana::foliage {

inline constexpr std::size_t kMaxGltfVertices = 2'000'000,
                             kMaxGltfIndices = 6'000'000;  // of a scene, instances counted

/// A primitive where its node puts it.
struct GltfPart {
  int material = -1;  ///< -1: the default one; otherwise it exists
  std::string mesh_name;
  std::vector<Vec3d> positions;  ///< scene units, finite
  std::vector<Vec3> normals;     ///< unit; computed where the file has none
  std::vector<Vec2> uvs;         ///< finite; zero where the file has none
  std::vector<std::uint32_t> indices;
};

/// Of the default scene, else of the first, else of all root nodes. Points and lines are left out, and so are nodes
/// whose scale is 0. Throws std::runtime_error naming the node, mesh or accessor: not finite, out of bounds, nodes in a
/// cycle or with two parents, too many triangles, none at all.
std::vector<GltfPart> gltf_triangles(const tinygltf::Model& model);

}  // namespace manzana::foliage
