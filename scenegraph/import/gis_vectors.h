#pragma once
/// Footprints and tree points of a GIS, by GDAL: GeoPackage, GeoJSON, Shapefile. In a build without GDAL nothing is.
///   if (is_gis_vectors(file)) CityFeatures city = read_gis_vectors(file, {}, options);
/// Polygons are buildings, points are trees, of all layers; other geometries are counted in the list of issues.
#include "scenegraph/import/import.h"

namespace manzana {

/// By its name: .gpkg, .geojson, .shp.
bool is_gis_vectors(const std::filesystem::path& file);

/// Of buildings the attributes height (metres) or levels, id, class; of trees those that `columns` names. Layers
/// without a reference system are of options.reference_system, else of WGS 84. Throws as read_osm does.
CityFeatures read_gis_vectors(const std::filesystem::path& file, const TreeColumns& columns,
                              const ImportOptions& options);

}  // namespace manzana
