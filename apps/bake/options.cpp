#include "apps/bake/options.h"

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace manzana::bake {
namespace {

constexpr const char* kAbout =
    "Prepare what is drawn, so that drawing does not wait for it, and write cities for other programs.\n"
    "Exit: 0 success, 1 bad input, 2 wrong usage.";
constexpr const char* kPlant =
    "Prepare a plant for every distance, and say what was taken for what. FILE is glTF (.glb, .gltf),\n"
    "OBJ (.obj), L-systems or the parameters of a species (.json); FILE#NAME chooses one of several\n"
    "L-systems.";

constexpr const char* kImport =
    "Import a city once, so that programs open it at once: FILE.manzana, written whole or not at all.";

constexpr const char* kTiles =
    "Write a city as a 3D Tiles 1.1 tileset, for CesiumJS and others: DIR/tileset.json, DIR/tiles, DIR/plants. Tiles "
    "are\n"
    "the nodes and blocks of the BqR-Tree. DIR is made, whole or not at all.";

constexpr const char* kGeopackage =
    "Write a city as a GeoPackage, for QGIS and others: layers of blocks, buildings and trees. FILE is replaced, "
    "whole\n"
    "or not at all.";

struct Texts {
  std::string source, visibility = "best";
};

CLI::App* add_plant(CLI::App& app, Options& options, Texts& texts) {
  CLI::App* plant = app.add_subcommand("plant", kPlant);
  plant->add_option("FILE", texts.source, "what to read")->required();
  plant->add_option("-o,--out", options.out, "the prepared plant to write, FILE.plant")->required();
  plant
      ->add_option("--visibility", texts.visibility,
                   "who counts what is seen of each cell of leaves: gpu, cpu, queries (occlusion queries on the GPU,\n"
                   "the reference), none; best: the GPU, or the CPU where GL is software or absent")
      ->check([](const std::string& name) -> std::string {
        try {
          return visibility_named(name), std::string();
        } catch (const std::invalid_argument& error) {
          return name + " " + error.what();
        }
      })
      ->capture_default_str();
  return plant;
}

/// What every command does alike that takes a city.
CLI::App* add_city_command(CLI::App& app, const char* name, const char* about, const char* out, Options& options) {
  CLI::App* command = app.add_subcommand(name, about);
  command
      ->add_option("CITY", options.city,
                   "builtin:town, or a file: OpenStreetMap, CityJSON, or footprints and trees (.gpkg, .shp, .geojson)")
      ->required();
  command->add_option("-o,--out", options.out, out)->required();
  command->add_option("--seed", options.import.seed, "of scattered trees and the built-in town")->capture_default_str();
  command->add_option("--terrain", options.terrain, "relief to stand on: GeoTIFF or SRTM (.tif, .hgt, .hgt.zip)");
  command->add_option("--crs", options.import.reference_system,
                      "reference system of files that name none, as EPSG:28992");
  return command;
}

CLI::App* add_import(CLI::App& app, Options& options) {
  CLI::App* city = add_city_command(app, "import", kImport, "the baked city to write, FILE.manzana", options);
  city->add_option("--cars", options.import.cars, "how many; without it the length of the streets decides")
      ->check(CLI::Range(0, 1000000));
  city->add_option("--lod", options.import.lod, "of CityJSON: the finest level of detail to take");
  city->add_flag("!--no-attributes", options.import.attributes, "leave out what the file says of things");
  return city;
}

}  // namespace

Parsed parse_options(int argc, const char* const* argv) {
  CLI::App app(kAbout, "manzana-bake");
  app.set_version_flag("--version", "manzana-bake " MANZANA_VERSION);
  app.require_subcommand(1);
  Options options;
  Texts texts;
  add_plant(app, options, texts);
  const CLI::App* city = add_import(app, options);
  const CLI::App* tiles = add_city_command(app, "tiles", kTiles, "the folder to write", options);
  const CLI::App* geopackage =
      add_city_command(app, "geopackage", kGeopackage, "the file to write, FILE.gpkg", options);
  if (auto reply = apps::parse(app, argc, argv)) return {std::nullopt, std::move(reply->text), reply->exit_code};
  if (city->parsed()) options.command = Command::city;
  if (city->parsed() && city->count("--cars") == 0) options.import.cars = -1;
  if (tiles->parsed()) options.command = Command::tiles;
  if (geopackage->parsed()) options.command = Command::geopackage;
  options.visibility = visibility_named(texts.visibility);
  options.source = foliage::parse_plant_source(texts.source);
  return {std::move(options), {}, 0};
}

}  // namespace manzana::bake
