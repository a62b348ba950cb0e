#include "foliage/import/gltf_plant.h"

#include <stdexcept>

namespace manzana::foliage {
PlantModel import_plant(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() + ": not read yet");
}
PlantModel import_plant(std::span<const unsigned char>, const std::string& name) {
  throw std::runtime_error(name + ": not read yet");
}
}  // namespace manzana::foliage
