#pragma once
/// A plant from a glTF file (.gltf, .glb) through tinygltf, with file access that cannot leave the file's folder.
///   Plant pine = read_plant("pine.glb");
/// Y is up in glTF. Vertex attribute _BRANCHID (a number from 0): of bark, the branch that it is of; of leaves, the
/// branch that carries them. "extras": {"organ": "leaf"} (or branch, flower, fruit) of a node, mesh, primitive or
/// material says what its triangles are. All else as assemble_plant.h has it.
/// All throw std::runtime_error ("FILE: what is wrong") for anything that cannot be drawn as it stands.
#include <filesystem>
#include <span>

#include "foliage/import/assemble_plant.h"

namespace manzana::foliage {

Plant read_plant(const std::filesystem::path& file);

/// With what was taken for what.
PlantReading examine_plant(const std::filesystem::path& file);

/// The same from memory, without any file access: for fuzzing, and for embedders. `name` stands in messages.
Plant read_plant(std::span<const unsigned char> bytes, const std::string& name);
PlantReading examine_plant(std::span<const unsigned char> bytes, const std::string& name);

}  // namespace manzana::foliage
