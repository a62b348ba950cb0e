#include <stdexcept>

#include "scenegraph/import/baked_city.h"
#include "scenegraph/import/cityjson.h"
#include "scenegraph/import/gis_vectors.h"
#include "scenegraph/import/import.h"

namespace manzana {

CityFeatures read_city(const std::string& city, const ImportOptions& options, const Progress& progress) {
  if (city == "builtin:town") return make_town(options.seed);
  if (city.starts_with("builtin:")) throw std::runtime_error(city + ": there is only builtin:town");
  if (is_baked(city))
    throw std::runtime_error(city + ": a baked city cannot be merged with others, or get another ground");
  if (is_gis_vectors(city)) return read_gis_vectors(city, {}, options);
  return is_cityjson(city) ? read_cityjson(city, options, progress) : read_osm(city, progress, options.attributes);
}

Imported import_city(const std::string& city, const ImportOptions& options, const Progress& progress) {
  if (is_baked(city)) return read_baked(city);
  return build_scene(read_city(city, options, progress), options, progress);
}

}  // namespace manzana
