#include <stdexcept>

#include "scenegraph/import/import.h"

namespace manzana {

Imported import_city(const std::string& city, const ImportOptions& options, const Progress& progress) {
  if (city == "builtin:town") return build_scene(make_town(options.seed), options, progress);
  if (city.starts_with("builtin:")) throw std::runtime_error(city + ": there is only builtin:town");
  return build_scene(read_osm(city, progress), options, progress);
}

}  // namespace manzana
