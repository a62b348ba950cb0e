#pragma once
/// OpenStreetMap XML, read leniently: an object that is wrong by itself (a coordinate that is no number, an id beyond
/// 64 bits) is told of with its line, and the rest of the file is read. libosmium's own XML reader gives the whole file
/// up there; its decompressors and its objects are used.
#include <functional>
#include <osmium/io/file.hpp>
#include <osmium/osm/object.hpp>
#include <string>

#include "scenegraph/import/features.h"

namespace manzana {

struct XmlSink {
  std::function<void(const osmium::OSMObject&)> object;  ///< valid during the call; deleted ones are passed over
  std::function<void(Issue)> issue;
  std::function<void(const std::string&)> attribution;  ///< of the top element, where it has one
  std::function<void(std::size_t)> bytes;               ///< of the file, read so far
};

/// Throws std::runtime_error ("what, line 3, column 95") where the file is not well-formed or not OpenStreetMap data.
/// Entities are refused, not expanded. Metadata (version, editor, time) is not read.
void read_osm_xml(const osmium::io::File& file, const XmlSink& sink);

}  // namespace manzana
