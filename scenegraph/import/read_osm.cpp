#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>

#include "scenegraph/import/osm_features.h"

namespace manzana {
namespace {

CityFeatures features_of(OsmFile osm, bool attributes) {
  const OsmShapes shapes(osm);
  CityFeatures city;
  city.attributes = AttributeWriter(attributes);
  city.frame = shapes.frame();
  city.attribution = osm.attribution;
  city.issues = std::move(osm.issues);
  read_buildings(osm, shapes, city);
  read_streets(osm, shapes, city);
  read_trees(osm, shapes, city);
  read_grounds(osm, shapes, city);
  const bool nothing = city.buildings.empty() && city.streets.empty() && city.trees.empty() && city.areas.empty();
  if (nothing) city.issues.push_back({"file", "holds nothing that can be drawn"});
  return city;
}

/// libosmium also takes formats that we do not want from strangers, and would fetch addresses by curl.
osmium::io::File checked_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw std::runtime_error(file.string() + ": no such file");
  if (std::filesystem::is_directory(file, error)) throw std::runtime_error(file.string() + ": is a folder");
  constexpr std::array<std::string_view, 4> kEndings{".osm", ".osm.gz", ".osm.bz2", ".pbf"};
  const std::string name = file.filename().string();
  if (std::ranges::none_of(kEndings, [&](std::string_view ending) { return name.ends_with(ending); }))
    throw std::runtime_error(file.string() +
                             ": not a name of an OpenStreetMap file (.osm, .osm.gz, .osm.bz2, .osm.pbf)");
  if (std::filesystem::file_size(file, error) == 0) throw std::runtime_error(file.string() + ": the file is empty");
  return osmium::io::File(std::filesystem::absolute(file).string());
}

}  // namespace

CityFeatures read_osm(const std::filesystem::path& file, const Progress& progress, bool attributes) {
  return features_of(load_osm(checked_file(file), file.string(), progress), attributes);
}

CityFeatures read_osm_bytes(std::string_view bytes, const std::string& format, const std::string& name,
                            bool attributes) {
  return features_of(load_osm(osmium::io::File(bytes.data(), bytes.size(), format), name, {}), attributes);
}

}  // namespace manzana
