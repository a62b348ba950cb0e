#pragma once
/// Points that stand for bare branches: blades of grass, stems of herbs, trees in winter, seen from so far away that
/// even a line for each is too much.  [Deussen 2005, section 10.3: whatever is small enough is points]
///   std::vector<LeafPoint> points = branch_points(plant, 256);
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// `count` points of the plant's finest lines, each for the same part of their area; in an order of which any first few
/// are spread over the plant. In place of normals they have their branches' directions, by which they are lit as
/// ribbons are; they have the bark's mean colour. Their areas sum up to what ribbons that turn to the eye hide, mean
/// over all directions, were none behind another. None of a plant whose branches have no lines. Cost: linear in lines,
/// and that of the picture.
std::vector<LeafPoint> branch_points(const PreparedPlant& plant, std::uint32_t count);

}  // namespace manzana::foliage
