#pragma once
/// What manzana-bake says of a plant.
#include <string>

#include "foliage/import/load_plant.h"

namespace manzana::bake {

/// What was read: branches by level, terminals by organ, and why triangles were taken for what they are.
std::string source_report(const foliage::PlantReading& reading);

/// What was made of it: levels, cells, points.
std::string prepared_report(const foliage::PreparedPlant& plant);

}  // namespace manzana::bake
