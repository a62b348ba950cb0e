#include "manzana/model.h"

#include <tbb/task_arena.h>

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <stdexcept>

#include "foliage/import/load_plant.h"
#include "foliage/import/species.h"
#include "scenegraph/import/osm_file.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

std::vector<foliage::PreparedPlant> plants_of(const Scene& scene, const LoadOptions& options,
                                              const Progress& progress) {
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  const auto stands = species_in(scene);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    if (!stands[i] || !options.trees) continue;
    foliage::PrepareOptions how;
    how.visibility_side = 0;
    how.progress = [&](double done) {
      if (progress) progress("plants", (static_cast<double>(i) + done) / static_cast<double>(plants.size()));
    };
    plants[i] = foliage::grow_or_prepare(foliage::kSpeciesNames[i], options.seed, options.plant_cache, how,
                                         [](const std::string&) {});
  }
  return plants;
}

std::shared_ptr<const Model> make_model(Imported imported, const LoadOptions& options, const Progress& progress) {
  auto plants = plants_of(imported.scene, options, progress);
  return std::make_shared<Model>(std::move(imported), std::move(plants));
}

/// In an arena of so many threads: with one TBB uses none but the caller's.
std::shared_ptr<const Model> within(int threads, const std::function<std::shared_ptr<const Model>()>& load) {
  tbb::task_arena arena(std::max(1, threads));
  return arena.execute(load);
}

ImportOptions import_options(const LoadOptions& options) { return {.seed = options.seed, .cars = options.cars}; }

}  // namespace

Model::Model(Imported imported, std::vector<foliage::PreparedPlant> plants)
    : imported_(std::move(imported)), plants_(std::move(plants)), prepared_(draw::prepare_city(imported_.scene)) {}

std::shared_ptr<const Model> Model::load(const std::string& city, const LoadOptions& options,
                                         const Progress& progress) {
  return within(options.threads,
                [&] { return make_model(import_city(city, import_options(options), progress), options, progress); });
}

std::shared_ptr<const Model> Model::load(std::span<const char> bytes, const std::string& format,
                                         const std::string& name, const LoadOptions& options,
                                         const Progress& progress) {
  return within(options.threads, [&] {
    CityFeatures features = read_osm_bytes({bytes.data(), bytes.size()}, format, name);
    return make_model(build_scene(std::move(features), import_options(options), progress), options, progress);
  });
}

std::shared_ptr<Nodes> Model::new_nodes() const { return std::make_shared<Nodes>(scene()); }

Mat4d Model::local_to_ecef() const {
  const GeoPoint& anchor = frame().anchor();
  std::vector<double> axes(9);
  Vec3d origin;
  GeographicLib::Geocentric::WGS84().Forward(anchor.lat_deg, anchor.lon_deg, anchor.height_m, origin.x, origin.y,
                                             origin.z, axes);
  Mat4d to(1);  // `axes` is row by row: ECEF from east, north, up
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) to[column][row] = axes[static_cast<std::size_t>(3 * row + column)];
  to[3] = glm::dvec4(origin, 1);
  return to;
}

Feature Model::feature(FeatureId id) const {
  const Scene& scene = imported_.scene;
  if (id == 0 || id > features()) throw std::out_of_range("no feature has the number " + std::to_string(id));
  const auto in = [&](const LayerTable& table, ObjectClass kind) -> std::optional<Feature> {
    const std::uint32_t row = table.row_first[id - 1];
    if (row == table.row_first[id]) return {};
    const culling::BoxD box{Vec3d(table.boxes[row].min) + scene.tree.origin,
                            Vec3d(table.boxes[row].max) + scene.tree.origin};
    const Vec3d middle = (box.min + box.max) / 2.0;
    return Feature{id, kind, box, frame().to_geo({middle.x, middle.y, box.min.z})};
  };
  if (const auto building = in(scene.buildings.table, kBuilding)) return *building;
  if (const auto surface = in(scene.surfaces.table, kSurface)) return *surface;
  return in(scene.trees.table, kTree).value();
}

}  // namespace manzana
