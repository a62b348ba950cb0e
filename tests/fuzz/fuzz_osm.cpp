// Any bytes, read as OpenStreetMap data: features that are sound, or a std::runtime_error, and nothing else.
// Input that begins with '<' is read as XML, everything else as PBF. A good start are files with blobs that are not
// compressed:  osmium cat city.osm.pbf -f pbf,pbf_compression=none -o corpus/city.pbf
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "scenegraph/import/osm_file.h"

namespace {

void require(bool sound) {
  if (!sound) std::abort();
}

bool finite(const std::vector<manzana::Vec2d>& points) {
  for (const manzana::Vec2d& p : points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
  return true;
}

void check(const manzana::CityFeatures& city) {
  for (const auto& b : city.buildings) {
    require(b.footprint.outer.size() >= 3 && finite(b.footprint.outer));
    require(b.height > b.min_height && b.min_height >= 0 && b.roof_height >= 0 && b.height < 3000 && b.levels >= 1);
  }
  for (const auto& s : city.streets) {
    require(s.line.size() == s.nodes.size() && s.line.size() >= 2 && finite(s.line));
    require(s.width > 0 && s.lanes >= 1);
  }
  for (const auto& t : city.trees) require(std::isfinite(t.position.x) && t.height > 0 && t.crown_radius > 0);
  for (const auto& a : city.areas) require(finite(a.shape.outer) && a.trees_per_ha >= 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    check(manzana::read_osm_bytes(bytes, bytes.starts_with('<') ? "osm" : "pbf", "fuzz"));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
