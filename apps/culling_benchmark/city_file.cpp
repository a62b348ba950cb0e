#include "apps/culling_benchmark/city_file.h"

#include <array>
#include <stdexcept>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "scenegraph/import/import.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::City;
using baselines::ObjectKind;
using culling::BoxD;

/// Of each species' model, in full.
std::array<std::uint32_t, kPlantSpecies> plant_triangles(std::uint64_t seed) {
  std::array<std::uint32_t, kPlantSpecies> triangles{};
  static_assert(foliage::kSpeciesNames.size() == kPlantSpecies);
  for (std::size_t i = 0; i < kPlantSpecies; ++i) {
    const foliage::Plant plant = foliage::grow_plant(foliage::builtin_species(foliage::kSpeciesNames[i]), seed);
    triangles[i] = static_cast<std::uint32_t>(plant.mesh.bark.triangles() + plant.mesh.leaves.triangles());
  }
  return triangles;
}

/// Adds the objects of one layer in one block; triangles_of(i) is asked for each.
template <class TrianglesOf>
void add_objects(City& city, const culling::BqrTree& tree, const LayerTable& table, std::uint32_t block,
                 ObjectKind kind, TrianglesOf triangles_of) {
  const culling::ObjectRun rows = table.rows(tree.block_objects[block]);
  for (std::uint32_t i = rows.first; i < rows.last; ++i) {
    const culling::Box& box = table.boxes[i];
    city.boxes.push_back({Vec3d(box.min) + tree.origin, Vec3d(box.max) + tree.origin});
    city.kinds.push_back(kind);
    city.triangles.push_back(triangles_of(i));
  }
}

void add_meshes(City& city, const Scene& scene, const MeshLayer& layer, std::uint32_t block, ObjectKind kind) {
  add_objects(city, scene.tree, layer.table, block, kind,
              [&](std::uint32_t i) { return (layer.index_first[i + 1] - layer.index_first[i]) / 3; });
}

culling::BlockVolume volume_of(const City& city, const Scene& scene, std::uint32_t block) {
  BoxD box;
  for (std::uint32_t i = city.first[block]; i < city.objects(); ++i) box = merge(box, city.boxes[i]);
  const Traffic& traffic = scene.traffic;
  for (std::uint32_t h = traffic.block_first[block]; h < traffic.block_first[block + 1]; ++h)
    box = merge(box, half_street_bounds(traffic, traffic.block_halves[h]));
  const Vec3d ground = scene.blocks[block].origin;
  if (box.empty()) box = merge(box, ground);
  return {Vec2d(ground), box, culling::enclosing_sphere(box)};
}

}  // namespace

City city_of(const Scene& scene, std::uint64_t seed) {
  City city;
  const auto plants = plant_triangles(seed);
  for (std::uint32_t block = 0; block < scene.blocks.size(); ++block) {
    add_meshes(city, scene, scene.buildings, block, ObjectKind::building);
    add_meshes(city, scene, scene.surfaces, block, ObjectKind::ground);
    add_objects(city, scene.tree, scene.trees.table, block, ObjectKind::tree,
                [&](std::uint32_t i) { return plants[scene.trees.instances[i].plant]; });
    city.blocks.push_back(volume_of(city, scene, block));
    city.first.push_back(city.objects());
    city.bounds = merge(city.bounds, city.blocks.back().box);
  }
  return city;
}

City read_city(const std::string& name, std::uint64_t seed) {
  const Imported imported = import_city(name, {.seed = seed}, [](std::string_view, double) {});
  City city = city_of(imported.scene, seed);
  if (city.objects() == 0) throw std::runtime_error(name + ": no object in it");
  return city;
}

}  // namespace manzana::culling_benchmark
