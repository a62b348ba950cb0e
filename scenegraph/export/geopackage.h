#pragma once
/// A scene as a GeoPackage, for QGIS and others: layers "blocks" (outline, number, bounds, what is in it), "buildings"
/// (footprint, id, name, class, height) and "trees" (species, height, crown), in WGS 84, with spatial indices.
///   write_geopackage(city.scene, "helsinki.gpkg", tell);
/// Longitudes go on beyond 180 degrees where the city does.  [OGC 12-128r18: GeoPackage 1.3]
#include <filesystem>
#include <functional>
#include <string_view>

#include "scenegraph/scene.h"

namespace manzana {

struct GeopackageWritten {
  std::size_t blocks = 0, buildings = 0, trees = 0;
};

/// Takes the place of a file that is there. Whole or not at all. Throws std::runtime_error ("FILE: what").
GeopackageWritten write_geopackage(const Scene& scene, const std::filesystem::path& file,
                                   const std::function<void(std::string_view stage, double fraction)>& progress = {});

}  // namespace manzana
