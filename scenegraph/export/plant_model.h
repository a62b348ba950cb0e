#pragma once
/// A plant as triangles where so many metres of its natural size may be wrong: what drawing shows there by its own law
/// (foliage/detail.h), in what glTF has: points become cards, lines become ribbons.
#include "foliage/plant_table.h"
#include "scenegraph/export/tile_content.h"

namespace manzana {

class PlantModels {
 public:
  explicit PlantModels(std::span<const foliage::PreparedPlant> plants);
  TileMesh at(std::uint16_t plant, double error_m) const;

 private:
  std::span<const foliage::PreparedPlant> plants_;
  foliage::PlantTable table_;
};

}  // namespace manzana
