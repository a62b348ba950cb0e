#pragma once
/// Relief under a city: buildings, streets, greens, trees and cars stand on it, and ground is laid where nothing is.
///   CityFeatures city = read_osm("bayreuth.osm.pbf", show);
///   const Terrain terrain = read_terrain("N49E011.hgt", city);
///   Imported imported = build_scene(std::move(city), terrain, {}, show);
/// Heights count from the lowest point under the city, so that the scene's ground stays at the ellipsoid's: a scene
/// does not know how high above the sea it lies.
#include "scenegraph/import/import.h"
#include "scenegraph/mesh.h"

namespace manzana {

/// A regular grid in plan, in L, metres; each cell is two triangles, divided from its lower left to its upper right
/// corner. The default is level.
struct Terrain {
  Vec2d origin{0, 0};
  double step = 1;
  std::uint32_t columns = 0, rows = 0;  ///< of corners, at least 2 each; or 0
  std::vector<float> heights;           ///< row by row from the south, none negative
  double base_m = 0;                    ///< what was taken from all heights of the file

  bool level() const { return heights.empty(); }
  /// Beyond the edge as at the edge.
  double at(const Vec2d& plan) const;
  /// Metres a metre to the east and north, smooth over the cells.
  Vec2d slope_at(const Vec2d& plan) const;
  Vec2d end() const { return origin + step * Vec2d(columns - 1, rows - 1); }
};

/// Of GeoTIFF and SRTM (.tif, .hgt, .hgt.zip), under all of the city and some way beyond; as fine as the file. Voids
/// are filled from their neighbours. Throws std::runtime_error ("FILE: what"): among others where the file does not
/// reach the city, or the build is without GDAL.
Terrain read_terrain(const std::filesystem::path& file, const CityFeatures& city);

/// What is laid over a terrain must bend where it does: triangles are cut along its cells, then raised. Positions are
/// (x, y relative to `center`, height above ground).
void drape(CityMesh& mesh, const Vec2d& center, const Terrain& terrain);

/// build_scene, on a terrain.
Imported build_scene(CityFeatures features, const Terrain& terrain, const ImportOptions& options,
                     const Progress& progress);

}  // namespace manzana
