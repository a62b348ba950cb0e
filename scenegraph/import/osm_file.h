#pragma once
/// An OpenStreetMap file in memory, whatever the order it came in.
///   OsmFile osm = load_osm(osmium::io::File("city.osm.pbf"), "city.osm.pbf", progress);
///   for (const osmium::Way* way : osm.ways) ...
/// Memory: 16 bytes a node; ways, relations and trees as libosmium keeps them.
#include <cstdint>
#include <optional>
#include <osmium/io/file.hpp>
#include <osmium/memory/buffer.hpp>
#include <osmium/osm.hpp>
#include <string>
#include <vector>

#include "scenegraph/import/import.h"

namespace manzana {

struct OsmNode {
  std::int64_t id = 0;
  osmium::Location at;
};

struct OsmFile {
  std::vector<OsmNode> nodes;  ///< ascending ids, each once, legal places only
  osmium::memory::Buffer objects{1024 * 1024,
                                 osmium::memory::Buffer::auto_grow::yes};  ///< what the rows below point to
  std::vector<const osmium::Node*> plants;                                 ///< natural=tree, natural=shrub
  std::vector<const osmium::Way*> ways;                                    ///< in the order of the file, each id once
  std::vector<const osmium::Relation*> relations;                          ///< likewise
  std::string attribution;
  std::vector<Issue> issues;
  const OsmNode* find(std::int64_t id) const;  ///< null: not in the file
};

/// Throws std::runtime_error ("name: what, where") when the file cannot be read.
OsmFile load_osm(const osmium::io::File& file, const std::string& name, const Progress& progress);

/// The same way for a file's bytes; `format` is libosmium's: "osm", "osm.gz", "osm.bz2", "pbf".
CityFeatures read_osm_bytes(std::string_view bytes, const std::string& format, const std::string& name,
                            bool attributes = false);

/// "way 4711 (building)".
std::string where_of(const osmium::OSMObject& object);
/// "way/4711"
std::string source_of(const osmium::OSMObject& object);

/// The credit that OpenStreetMap's licence asks for.
inline constexpr const char* kOsmCredit = "© OpenStreetMap contributors";

}  // namespace manzana
