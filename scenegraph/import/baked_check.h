#pragma once
/// Whether the columns of a scene that was read refer to each other as the importer's do: no index leaves its column,
/// no node of the tree is reached twice, runs follow each other. What would only draw nonsense is not looked for.
#include "scenegraph/scene.h"

namespace manzana {

/// Throws std::runtime_error ("the tree's node 7 ...").
void check_scene(const Scene& scene);

}  // namespace manzana
