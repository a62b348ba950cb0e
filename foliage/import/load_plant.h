#pragma once
/// A plant from any file that plants come in, prepared, and kept prepared.
///   const PreparedPlant oak = load_or_prepare({"oak.glb"}, default_cache_folder(), {}, tell);
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "foliage/import/assemble_plant.h"
#include "foliage/prepare.h"

namespace manzana::foliage {

struct PlantSource {
  std::filesystem::path file;  ///< .glb, .gltf: glTF; .obj; .json: L-systems, or the parameters of a species
  std::string system = {};     ///< which L-system, where the file has several
  std::uint64_t seed = 1;      ///< of a species
};

/// "FILE" or "FILE#SYSTEM"; a file that bears the whole name goes first.
PlantSource parse_plant_source(const std::string& text);

/// Throws std::runtime_error ("FILE: what is wrong").
PlantReading load_plant(const PlantSource& source);

using TellLine = std::function<void(const std::string&)>;

/// $XDG_CACHE_HOME/manzana, else ~/.cache/manzana; nothing where neither is known.
std::optional<std::filesystem::path> default_cache_folder();

/// load_plant() and prepare(); or what the folder keeps of the same, done before: of the same content (of the files
/// that it refers to as well), options and format. Without a folder nothing is kept. `tell` gets notes, and a line when
/// a kept plant is damaged and made again, or cannot be kept. Throws what load_plant() throws.
PreparedPlant load_or_prepare(const PlantSource& source, const std::optional<std::filesystem::path>& cache_folder,
                              const PrepareOptions& options, const TellLine& tell);

/// The same for a built-in species (foliage/import/species.h), grown from a seed.
PreparedPlant grow_or_prepare(std::string_view species, std::uint64_t seed,
                              const std::optional<std::filesystem::path>& cache_folder, const PrepareOptions& options,
                              const TellLine& tell);

}  // namespace manzana::foliage
