#pragma once
/// What the command line says.
///   Parsed parsed = parse_options(argc, argv);
///   if (!parsed.options) return apps::reply(parsed);        // --help, --version or wrong usage
#include <filesystem>

#include "apps/bake/visibility.h"
#include "apps/common/program.h"
#include "foliage/import/load_plant.h"
#include "scenegraph/import/import.h"

namespace manzana::bake {

enum class Command : std::uint8_t { plant, city, tiles, geopackage };

struct Options {
  Command command = Command::plant;
  std::filesystem::path out;
  foliage::PlantSource source;  ///< of a plant
  VisibilityBy visibility = VisibilityBy::best;
  std::string city;               ///< of all other commands
  std::filesystem::path terrain;  ///< empty: level
  ImportOptions import{.cars = 0, .attributes = true};
};

using Parsed = apps::Parsed<Options>;
Parsed parse_options(int argc, const char* const* argv);

}  // namespace manzana::bake
