#pragma once
/// A building's mesh with fewer triangles, as it may be seen from afar: edge_collapse.h on its points, and then every
/// corner has again what its surface says of it.
///   const auto levels = levels_of(mesh);       // levels[0] is within kMeshLevelErrors[0] metres
/// What is seen from both sides stays so. Corners keep colour, material and picture of their surface; its window bays,
/// tiles and pictures go on as they did on the largest triangle of it. Surfaces of rounded normals stay as they are,
/// and so do those whose picture is not laid on them straight: with it their seams stay.
#include "scenegraph/scene.h"

namespace manzana {

/// A level is empty where it would have more than this share of the triangles that are drawn without it.
inline constexpr double kLevelGain = 0.7;

std::array<CityMesh, kMeshLevels> levels_of(const CityMesh& mesh);

}  // namespace manzana
