// What GDAL opens of any bytes, as footprints and trees, relief or orthophoto: what is finite, or std::runtime_error.
// The first byte says as which; the city that relief and photo lie under is at 49.5 north, 11.5 east.
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "scenegraph/import/gis_vectors.h"
#include "scenegraph/import/read_photo.h"
#include "scenegraph/import/terrain.h"
#include "tests/fuzz/input_file.h"

namespace {

using namespace manzana;
using Path = std::filesystem::path;

void demand(bool sound) {
  if (!sound) std::abort();
}

void read_vectors(const Path& file) {
  const CityFeatures city = read_gis_vectors(file, {}, {});
  for (const BuildingFeature& building : city.buildings) {
    demand(std::isfinite(building.height) && building.height > building.min_height);
    for (const Vec2d& p : building.footprint.outer) demand(std::isfinite(p.x + p.y));
  }
  for (const TreeFeature& tree : city.trees)
    demand(std::isfinite(tree.position.x + tree.position.y) && tree.height > 0);
}

CityFeatures small_city() {
  CityFeatures city;
  city.frame = LocalFrame({49.5, 11.5, 0});
  city.trees.push_back({.position = {-300, -200}});
  city.trees.push_back({.position = {300, 200}});
  return city;
}

void read_relief(const Path& file) {
  const Terrain terrain = read_terrain(file, small_city());
  demand(terrain.heights.size() == std::size_t{terrain.columns} * terrain.rows);
  for (const float height : terrain.heights) demand(std::isfinite(height) && height >= 0);
}

void read_photo(const Path& file) {
  const GroundPhoto photo = read_ground_photo(file, small_city().frame, {{-300, -200, 0}, {300, 200, 10}}, {});
  for (const GroundPhoto::Level& level : photo.levels)
    demand(level.texels.size() == std::size_t{level.columns} * level.rows);
}

struct Kind {
  const char* name;
  void (*read)(const Path&);
};
constexpr std::array kKinds{Kind{"city.gpkg", read_vectors}, Kind{"city.geojson", read_vectors},
                            Kind{"relief.tif", read_relief}, Kind{"photo.tif", read_photo}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const InputFile file;
  if (size == 0) return 0;
  const Kind& kind = kKinds[data[0] % kKinds.size()];
  try {
    kind.read(file.with({data + 1, size - 1}, kind.name));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
