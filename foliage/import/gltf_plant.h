#pragma once
/// A tree from a glTF file (.gltf, .glb) through tinygltf, with file access that cannot leave the file's folder.
#include <filesystem>
#include <span>

#include "foliage/plant_model.h"

namespace manzana::foliage {

/// Two levels: as it is, and reduced by meshoptimizer. Leaves are the materials with alpha, or named so; Y is up in
/// glTF. All leaves wear one texture and all bark another, those with the most area: several in a class lose their own.
/// Throws std::runtime_error ("FILE: what is wrong") for anything that cannot be drawn as it stands.
PlantModel import_plant(const std::filesystem::path& file);

/// The same from memory, without any file access: for fuzzing, and for embedders. `name` stands in messages.
PlantModel import_plant(std::span<const unsigned char> bytes, const std::string& name);

}  // namespace manzana::foliage
