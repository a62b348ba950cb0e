#pragma once
/// The materials of a glTF file as a plant's triangles wear them.
#include <tiny_gltf.h>

#include "foliage/import/source_part.h"

namespace manzana::foliage {

/// `model` must outlive what is returned: pictures are decoded when they are asked for, and throw std::runtime_error
/// then.
std::vector<SourceMaterial> gltf_materials(const tinygltf::Model& model);

/// extras: {"organ": "leaf"} (branch, leaf, flower, fruit).
std::optional<PlantPart> told_by_extras(const tinygltf::Value& extras);

}  // namespace manzana::foliage
