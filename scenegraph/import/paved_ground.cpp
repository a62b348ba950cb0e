#include "scenegraph/import/paved_ground.h"

#include <cmath>

namespace manzana {

std::vector<AreaFeature> paved_ground(const StreetFaces& faces, std::span<const BuildingFeature> buildings) {
  std::vector<double> covered(faces.faces().size(), 0);
  for (const BuildingFeature& building : buildings) {
    const Vec2d middle = box_of(building.footprint.outer).center();
    if (building.min_height > 0 || !std::isfinite(middle.x + middle.y)) continue;
    const std::uint32_t face = faces.locate(middle);
    if (face != kNoFace) covered[face] += centroid(building.footprint).area;
  }
  std::vector<AreaFeature> ground;
  for (std::size_t f = 0; f < covered.size(); ++f) {
    const StreetFace& face = faces.faces()[f];
    if (covered[f] > kPavedCover * face.centroid.area)
      ground.push_back({"ground of a dense block", face.shape, Material::concrete});
  }
  return ground;
}

}  // namespace manzana
