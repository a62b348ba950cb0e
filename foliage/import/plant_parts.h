#pragma once
/// From the triangles of a glTF scene to a plant: what is leaf and what is bark, and the picture that each wears.
#include <tiny_gltf.h>

#include "foliage/plant_mesh.h"

namespace manzana::foliage {

struct PlantParts {
  PlantMesh mesh;  ///< foot at the origin, z up, the file's units
  Image leaf, bark;
};

/// A triangle is leaf by its material's name; else by alpha (mask or blend); else, where nothing told so far, by a
/// two-sided material, the mesh's name, or the greenness of its base colour. A class wears the texture of the material
/// that covers most of its area. Throws std::runtime_error.
PlantParts plant_parts(const tinygltf::Model& model);

}  // namespace manzana::foliage
