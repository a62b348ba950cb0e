// manzana-bake: prepares plants and cities ahead of time, and writes cities for other programs.
// SHOWS: load_plant, prepare, bake_visibility, write_prepared; import_city, write_baked, write_tiles. READ FIRST:
// foliage/prepare.h, scenegraph/import/baked_city.h, scenegraph/export/tiles.h.
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "apps/bake/options.h"
#include "apps/bake/report.h"
#include "apps/common/progress_bar.h"
#include "foliage/import/plant_cache.h"
#include "scenegraph/export/geopackage.h"
#include "scenegraph/export/tiles.h"
#include "scenegraph/import/baked_city.h"
#include "scenegraph/import/scene_plants.h"
#include "scenegraph/import/terrain.h"
#include "scenegraph/tree_sites.h"

namespace {

using namespace manzana;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

/// And who counted what is seen of its cells.
std::pair<foliage::PreparedPlant, std::string> prepared(const foliage::Plant& plant, const bake::Options& options) {
  constexpr double kBefore = 0.4;  // of the work, where visibility is counted
  const double before = options.visibility == bake::VisibilityBy::none ? 1 : kBefore;
  apps::ProgressBar bar(stderr);
  foliage::PrepareOptions how;
  how.visibility_side = 0;
  how.progress = [&](double done) { bar.show("preparing", before * done); };
  try {
    foliage::PreparedPlant ready = foliage::prepare(plant, how);
    const auto tell = [&](double done) { bar.show("preparing", before + (1 - before) * done); };
    std::string by = bake::bake_visibility(ready, options.visibility, tell);
    tell(1);
    return {std::move(ready), std::move(by)};
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(options.source.file.string() + ": " + error.what());
  }
}

int bake_plant(const bake::Options& options) {
  const double start = seconds_now();
  const foliage::PlantReading reading = foliage::load_plant(options.source);
  print(bake::source_report(reading));
  const double read = seconds_now();
  const auto [plant, counted_by] = prepared(reading.plant, options);
  print(bake::prepared_report(plant));
  std::printf("visibility %u directions a side, by: %s\n", plant.visibility.side, counted_by.c_str());
  foliage::write_prepared(options.out, plant);
  std::printf("seconds    %.2f to read, %.2f to prepare and write %s\n", read - start, seconds_now() - read,
              options.out.c_str());
  return 0;
}

Imported read(const bake::Options& options, const Progress& show) {
  if (is_baked(options.city) && options.terrain.empty()) return read_baked(options.city);
  CityFeatures features = read_city(options.city, options.import, show);
  const Terrain terrain = options.terrain.empty() ? Terrain() : read_terrain(options.terrain, features);
  Imported city = build_scene(std::move(features), terrain, options.import, show);
  if (!city.issues.empty())
    std::printf("issues     %zu of the file, as the walkthrough lists them\n", city.issues.size());
  return city;
}

int bake_city(const bake::Options& options) {
  if (!is_baked(options.out)) throw std::runtime_error(options.out.string() + ": is no name of a baked city, .manzana");
  const double start = seconds_now();
  apps::ProgressBar bar(stderr);
  const Progress show = [&](std::string_view stage, double done) { bar.show(stage, done); };
  Imported city = read(options, show);
  const auto tell = [](const std::string& line) { print(line + "\n"); };
  const double imported = seconds_now();
  keep_leeway(city.scene, scene_plants(city.scene, {options.import.seed, foliage::default_cache_folder()}, show, tell));
  const double prepared = seconds_now();
  write_baked(options.out, city);
  const Scene& scene = city.scene;
  std::printf("city       %zu blocks, %u buildings, %u trees, %u cars; %.1f MB of attributes\n", city.report.blocks,
              scene.buildings.table.size(), scene.trees.table.size(), scene.traffic.cars(),
              static_cast<double>(bytes_of(scene.attributes)) / 1e6);
  std::printf("seconds    %.2f to import, %.2f to prepare trees, %.2f to write %s, %.1f MB\n", imported - start,
              prepared - imported, seconds_now() - prepared, options.out.c_str(),
              static_cast<double>(std::filesystem::file_size(options.out)) / 1e6);
  return 0;
}

int bake_tiles(const bake::Options& options) {
  const double start = seconds_now();
  apps::ProgressBar bar(stderr);
  const Progress show = [&](std::string_view stage, double done) { bar.show(stage, done); };
  const Imported city = read(options, show);
  const auto tell = [](const std::string& line) { print(line + "\n"); };
  const auto plants = scene_plants(city.scene, {options.import.seed, foliage::default_cache_folder()}, show, tell);
  const double imported = seconds_now();
  const TilesWritten written = write_tiles(city.scene, plants, options.out, show);
  std::printf("tileset    %zu tiles, %zu files, %.1f MB; %zu buildings, %zu trees\n", written.tiles, written.files,
              static_cast<double>(written.bytes) / 1e6, written.buildings, written.trees);
  std::printf("seconds    %.2f to import, %.2f to write %s\n", imported - start, seconds_now() - imported,
              options.out.c_str());
  return 0;
}

int bake_geopackage(const bake::Options& options) {
  apps::ProgressBar bar(stderr);
  const Progress show = [&](std::string_view stage, double done) { bar.show(stage, done); };
  const Imported city = read(options, show);
  const GeopackageWritten written = write_geopackage(city.scene, options.out, show);
  std::printf("layers     %zu blocks, %zu buildings, %zu trees in %s\n", written.blocks, written.buildings,
              written.trees, options.out.c_str());
  return 0;
}

int run(const bake::Options& options) {
  switch (options.command) {
    case bake::Command::city:
      return bake_city(options);
    case bake::Command::tiles:
      return bake_tiles(options);
    case bake::Command::geopackage:
      return bake_geopackage(options);
    case bake::Command::plant:
      break;
  }
  return bake_plant(options);
}

}  // namespace

int main(int argc, char** argv) {
  const bake::Parsed parsed = bake::parse_options(argc, argv);
  if (!parsed.options) return apps::reply(parsed);
  const bake::Options& options = *parsed.options;
  const std::string subject = options.city.empty() ? options.source.file.string() : options.city;
  return apps::guarded("manzana-bake", subject, [&] { return run(options); });
}
