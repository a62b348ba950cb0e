#pragma once
/// From a file to a scene.
///   Imported city = import_city("helsinki.osm.pbf", {}, show);
///   for (const Issue& issue : city.issues) log(issue.where, issue.what);
#include <filesystem>
#include <functional>
#include <limits>
#include <string_view>

#include "scenegraph/import/features.h"
#include "scenegraph/scene.h"

namespace manzana {

/// Called now and then, from the calling thread: what is being done, and how much of it (0 to 1).
using Progress = std::function<void(std::string_view stage, double fraction)>;

struct ImportOptions {
  std::uint64_t seed = 1;                                ///< of scattered trees, cars and the built-in town
  int cars = -1;                                         ///< how many; -1: by the length of the streets, at most 20 000
  double lod = std::numeric_limits<double>::infinity();  ///< of CityJSON: the finest that is wanted
  bool attributes = false;                               ///< keep what files say of things, as text
  std::string reference_system = {};                     ///< of files that name none: "EPSG:28992"; empty: none
};

/// What the report of an import says.
struct ImportReport {
  std::size_t blocks = 0, fallback_blocks = 0;          ///< fallback: not a face of the street network
  std::size_t objects = 0, fallback_objects = 0;        ///< objects in fallback blocks
  std::size_t objects_median = 0, objects_largest = 0;  ///< a block
  double seconds = 0;
};

struct Imported {
  Scene scene;
  std::vector<Issue> issues;
  ImportReport report;
};

/// Throws std::runtime_error ("FILE: what, where") when the file cannot be read at all.
CityFeatures read_osm(const std::filesystem::path& file, const Progress& progress, bool attributes = false);

/// Throws as read_osm does.
CityFeatures read_cityjson(const std::filesystem::path& file, const ImportOptions& options, const Progress& progress);

/// Columns of a list of trees, or properties of its GeoJSON. Empty: what they are usually called, if it has them.
struct TreeColumns {
  std::string lat = {}, lon = {}, x = {}, y = {};  ///< a place: degrees of WGS 84, or x and y of the reference system
  std::string species = {}, height = {}, crown = {};  ///< botanical; metres; metres of the crown's diameter
};

/// .csv, .tsv, .geojson, .json. Throws as read_osm does.
CityFeatures read_tree_list(const std::filesystem::path& file, const TreeColumns& columns,
                            const ImportOptions& options);

/// The built-in town: made up, the same for a seed on every machine. `times`, at least 1: about as large in area, with
/// the town in its middle.
CityFeatures make_town(std::uint64_t seed, double times = 1);

/// `city` is "builtin:town", "builtin:town:10" (ten times as large) or a file: .osm, .osm.gz, .osm.bz2, .osm.pbf;
/// .city.json, .jsonl, .json of CityJSON. Throws as read_osm does.
CityFeatures read_city(const std::string& city, const ImportOptions& options, const Progress& progress);

/// Several sources make one city, in the frame of the first. What lies farther than 300 km from there is left out, and
/// its number listed.
void merge(CityFeatures& into, CityFeatures more);

/// Scenes that are there already, baked ones too, as one: likewise, in the frame of the first, under a tree of its own.
/// Meshes come to memory; what neighbours hide of trees is to be found again. At least one.
Imported merge(std::vector<Imported> cities);

/// Never fails for bad features: they are listed.
Imported build_scene(CityFeatures features, const ImportOptions& options, const Progress& progress);

/// read_city, then build_scene; or a baked city, FILE.manzana (scenegraph/import/baked_city.h), as it is.
Imported import_city(const std::string& city, const ImportOptions& options, const Progress& progress);

}  // namespace manzana
