#include "manzana/model.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

#include "scenegraph/earth_centred.h"
#include "scenegraph/import/osm_file.h"
#include "scenegraph/import/read_photo.h"
#include "scenegraph/import/scene_plants.h"
#include "scenegraph/tree_sites.h"

namespace manzana {
namespace {

std::vector<foliage::PreparedPlant> plants_of(const Scene& scene, const LoadOptions& options,
                                              const Progress& progress) {
  if (!options.trees) return std::vector<foliage::PreparedPlant>(kPlantSpecies);
  return scene_plants(scene, {options.seed, options.plant_cache}, progress, [](const std::string&) {});
}

std::shared_ptr<const Model> make_model(Imported imported, const LoadOptions& options, const Progress& progress) {
  Scene& scene = imported.scene;
  if (!options.orthophoto.empty()) scene.photo = read_ground_photo(options.orthophoto, scene.frame, scene.bounds, {});
  auto plants = plants_of(scene, options, progress);
  return std::make_shared<Model>(std::move(imported), std::move(plants), options.plant_cache);
}

/// In an arena of so many threads: with one TBB uses none but the caller's.
std::shared_ptr<const Model> within(int threads, const std::function<std::shared_ptr<const Model>()>& load) {
  tbb::task_arena arena(std::max(1, threads));
  return arena.execute(load);
}

ImportOptions import_options(const LoadOptions& options) {
  return {.seed = options.seed, .cars = options.cars, .attributes = options.attributes};
}

}  // namespace

Model::Model(Imported imported, std::vector<foliage::PreparedPlant> plants,
             std::optional<std::filesystem::path> plant_cache)
    : imported_(std::move(imported)), plants_(std::move(plants)), plant_cache_(std::move(plant_cache)) {
  keep_leeway(imported_.scene, plants_);
}

std::shared_ptr<const Model> Model::load(const std::string& city, const LoadOptions& options,
                                         const Progress& progress) {
  return within(options.threads,
                [&] { return make_model(import_city(city, import_options(options), progress), options, progress); });
}

std::shared_ptr<const Model> Model::load(std::span<const char> bytes, const std::string& format,
                                         const std::string& name, const LoadOptions& options,
                                         const Progress& progress) {
  return within(options.threads, [&] {
    CityFeatures features = read_osm_bytes({bytes.data(), bytes.size()}, format, name, options.attributes);
    return make_model(build_scene(std::move(features), import_options(options), progress), options, progress);
  });
}

std::shared_ptr<Nodes> Model::new_nodes() const { return std::make_shared<Nodes>(scene()); }

Mat4d Model::local_to_ecef() const { return manzana::local_to_ecef(frame()); }

Feature Model::feature(FeatureId id) const {
  const Scene& scene = imported_.scene;
  if (id == 0 || id > features()) throw std::out_of_range("no feature has the number " + std::to_string(id));
  const auto in = [&](const LayerTable& table, ObjectClass kind) -> std::optional<Feature> {
    const std::uint32_t row = table.row_first[id - 1];
    if (row == table.row_first[id]) return {};
    const culling::BoxD box{Vec3d(table.boxes[row].min) + scene.tree.origin,
                            Vec3d(table.boxes[row].max) + scene.tree.origin};
    const Vec3d middle = (box.min + box.max) / 2.0;
    return Feature{id, kind, box, frame().to_geo({middle.x, middle.y, box.min.z}), scene.attributes.of(id - 1)};
  };
  if (const auto building = in(scene.buildings.table, kBuilding)) return *building;
  if (const auto surface = in(scene.surfaces.table, kSurface)) return *surface;
  return in(scene.trees.table, kTree).value();
}

}  // namespace manzana
