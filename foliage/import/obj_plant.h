#pragma once
/// A plant from a Wavefront OBJ file, as Xfrog, L-Studio and modelling programs write it.
///   Plant lilac = examine_obj("lilac.obj").plant;
/// Y is up. A group (g, o) with a name for branch or leaf, or a material (usemtl) with one, says what its faces are;
/// each group of branch is a branch of its own.  [Gadbem 2011, sections 3.2.1 and 3.2.2] What is not said is told by
/// shape: assemble_plant.h.
#include <filesystem>
#include <span>
#include <string>

#include "foliage/import/assemble_plant.h"

namespace manzana::foliage {

/// Throws std::runtime_error ("FILE: line 12: what is wrong") for what cannot be drawn as it stands, and for libraries
/// and textures outside the file's folder; notes those that are absent or broken.
PlantReading examine_obj(const std::filesystem::path& file);

/// From memory, without any file access: for fuzzing. `name` stands in messages.
PlantReading examine_obj(std::span<const unsigned char> bytes, const std::string& name);

}  // namespace manzana::foliage
