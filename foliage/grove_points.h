#pragma once
/// A plant as a few points of one size, which groves draw: of what is seen of it, leaves and branches alike, so that
/// any of its points are as light and as green as what is seen, and none is a larger square than another.
///   const std::vector<LeafPoint> surface = grove_surface(plant), points = grove_points(plant, surface);
#include <span>
#include <vector>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// More than a tree has in a grove, so that trees differ; a power of two.
inline constexpr std::uint32_t kPlantPoints = 256;

/// One of the plant's levels of points, and points on its branches (foliage/branch_points.h). Those of leaves are
/// marked so (glsl::kGroveLeaf). Empty for a plant of nothing.
std::vector<LeafPoint> grove_surface(const PreparedPlant& plant);

/// kPlantPoints, each for the same part of what is seen of the surface from all sides and heights; in an order of which
/// any first few are spread over the plant. Areas are equal and sum up to the surface's. Cost: that of 48 pictures.
std::vector<LeafPoint> grove_points(const PreparedPlant& plant, std::span<const LeafPoint> surface);

}  // namespace manzana::foliage
