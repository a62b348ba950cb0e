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

}  // namespace manzana::foliage
