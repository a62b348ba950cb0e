#pragma once
/// What the command line says.
///   Parsed parsed = parse_options(argc, argv);
///   if (!parsed.options) return apps::reply(parsed);        // --help, --version or wrong usage
#include <filesystem>

#include "apps/bake/visibility.h"
#include "apps/common/program.h"
#include "foliage/import/load_plant.h"

namespace manzana::bake {

struct Options {
  foliage::PlantSource source;
  std::filesystem::path out;
  VisibilityBy visibility = VisibilityBy::best;
};

using Parsed = apps::Parsed<Options>;
Parsed parse_options(int argc, const char* const* argv);

}  // namespace manzana::bake
