#pragma once
/// What the command line says.
///   Parsed parsed = parse_options(argc, argv);
///   if (!parsed.options) return apps::reply(parsed);        // --help, --version or wrong usage
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/program.h"
#include "scenegraph/draw/renderer.h"
#include "scenegraph/import/import.h"
#include "scenegraph/visible.h"

namespace manzana::walkthrough {

/// --plant SPECIES=FILE.glb: the model for a species.
struct PlantFile {
  PlantSpecies species = PlantSpecies::broadleaf;
  std::filesystem::path file;
};

struct Options {
  std::string city = "builtin:town";  ///< empty: trees alone
  std::vector<std::string> more;      ///< other cities, laid beside or over the first
  std::vector<std::filesystem::path> tree_lists;
  TreeColumns tree_columns;
  bool headless = false;
  std::string path = "tour";  ///< built-in name, or a file
  int frames = 300, every = 30;
  draw::Size size{1280, 720};
  Structure structure = Structure::bqr;
  culling::ClassMask only = culling::kAllClasses;
  std::filesystem::path out = "manzana-out";
  double gpu_mb = 0;  ///< of the device, at most; 0: no limit
  bool report_memory = false;
  double hours = 0;     ///< that the frames are spread over; 0: they follow each other
  std::string quality;  ///< fast, balanced, accurate or exact; empty: by the renderer's name
  std::uint64_t seed = 1;
  int cars = -1;  ///< -1: by the length of the streets
  double lod = ImportOptions{}.lod;
  std::string reference_system;      ///< of files that name none
  std::filesystem::path terrain;     ///< empty: level
  std::filesystem::path orthophoto;  ///< empty: none
  std::vector<PlantFile> plants;
  std::optional<double> tree_error_px;  ///< without it the quality decides
  double tree_vertices = 0, tree_ms = 0;
  std::optional<foliage::Law> tree_law;          ///< the same
  std::optional<std::array<double, 2>> sun_deg;  ///< azimuth and height; without it from the south-east
  bool trees_by_node = false, wind = true, packs = true;
};

inline std::size_t gpu_bytes(const Options& options) { return static_cast<std::size_t>(options.gpu_mb * 1e6); }

using Parsed = apps::Parsed<Options>;
Parsed parse_options(int argc, const char* const* argv);

const char* name_of(Structure structure);  ///< bqr, none

}  // namespace manzana::walkthrough
