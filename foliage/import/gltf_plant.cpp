#include "foliage/import/gltf_plant.h"

#include <algorithm>
#include <stdexcept>

#include "foliage/few_cards.h"
#include "foliage/import/gltf_files.h"
#include "foliage/import/gltf_materials.h"
#include "foliage/import/gltf_triangles.h"
#include "foliage/simplify.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kFineTriangles = 20'000, kFineBark = 8'000;
constexpr std::size_t kCoarseBark = 40, kCoarseCards = 80, kCoarseCrown = 90;  // triangles
constexpr float kFineRadiusPx = 60;

/// Cards have few triangles each; a crown modelled as one surface has many.
bool made_of_cards(const MeshPart& leaves) { return leaves.triangles() <= 8 * count_cards(leaves); }

/// At most about kFineTriangles, leaves before bark.
PlantMesh fine_mesh(PlantMesh mesh, const Silhouette& silhouette) {
  if (mesh.bark.triangles() + mesh.leaves.triangles() <= kFineTriangles) return mesh;
  const std::size_t left_for_bark = kFineTriangles - std::min(kFineTriangles, mesh.leaves.triangles());
  mesh.bark = simplified(mesh.bark, std::max(kFineBark, left_for_bark));
  const std::size_t target = kFineTriangles - std::min(kFineTriangles / 2, mesh.bark.triangles());
  if (mesh.leaves.triangles() <= target) return mesh;
  if (!made_of_cards(mesh.leaves))
    mesh.leaves = simplified(mesh.leaves, target);
  else
    mesh.leaves =
        thinned_cards(mesh, silhouette, static_cast<float>(target) / static_cast<float>(mesh.leaves.triangles()));
  return mesh;
}

PlantMesh coarse_mesh(const PlantMesh& fine, const Silhouette& silhouette) {
  PlantMesh coarse{simplified(largest_piece(fine.bark), kCoarseBark), {}};
  if (!made_of_cards(fine.leaves)) {
    coarse.leaves = simplified(fine.leaves, kCoarseCrown);
  } else if (!fine.leaves.indices.empty()) {
    const std::size_t each = (fine.leaves.triangles() + count_cards(fine.leaves) - 1) / count_cards(fine.leaves);
    coarse.leaves = few_cards(fine, coarse.bark, silhouette, kCoarseCards / each);
  }
  return coarse;
}

PlantModel model_of(Plant plant) {
  const Silhouette silhouette{plant.leaf_image, measure(plant.mesh)};
  const PlantMesh fine = fine_mesh(std::move(plant.mesh), silhouette);
  PlantMesh coarse = coarse_mesh(fine, silhouette);
  take_light(coarse.leaves, fine.leaves);
  const PlantSize drawn = measure(fine);  // fewer triangles may reach less far
  PlantModel model{plant.name, drawn.height, drawn.radius, plant.leaf_image, plant.bark_image, {}};
  model.levels = {finish_level(fine, drawn, kFineRadiusPx), finish_level(coarse, drawn, 0)};
  return model;
}

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

PlantModel import_plant(const std::filesystem::path& file) { return model_of(read_plant(file)); }
PlantModel import_plant(std::span<const unsigned char> bytes, const std::string& name) {
  return model_of(read_plant(bytes, name));
}

}  // namespace manzana::foliage
