#include "foliage/import/gltf_plant.h"

#include <stdexcept>

#include "foliage/import/gltf_files.h"
#include "foliage/import/gltf_materials.h"
#include "foliage/import/gltf_triangles.h"

namespace manzana::foliage {
namespace {

PlantReading read_bytes(std::span<const unsigned char> bytes, const std::string& name,
                        const std::optional<std::filesystem::path>& folder) {
  FolderFiles files(folder, kMaxGltfBytes);
  const tinygltf::Model gltf = load_gltf(bytes, files);
  PlantReading reading = assemble_plant(name, gltf_triangles(gltf), gltf_materials(gltf));
  reading.files = files.names_read();
  return reading;
}

}  // namespace

PlantReading examine_plant(const std::filesystem::path& file) {
  try {
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    return read_bytes(read_file(file), file.stem().string(), folder);
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

PlantReading examine_plant(std::span<const unsigned char> bytes, const std::string& name) {
  try {
    return read_bytes(bytes, name, std::nullopt);
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

Plant read_plant(const std::filesystem::path& file) { return examine_plant(file).plant; }
Plant read_plant(std::span<const unsigned char> bytes, const std::string& name) {
  return examine_plant(bytes, name).plant;
}

}  // namespace manzana::foliage
