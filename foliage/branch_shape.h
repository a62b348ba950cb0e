#pragma once
/// What a branch comes down to: a polyline of few points whose ribbon hides as much as the branch did, and the measures
/// by which branches are put in order.
#include <span>

#include "foliage/plant.h"

namespace manzana::foliage {

struct BranchShape {
  std::vector<CentrePoint> line;  ///< two points or more; none for a branch without extent
  float length_m = 0;             ///< of the line
  float width_m = 0;              ///< the largest: by the centre line, or by the corner farthest from the line
  float area_m2 = 0;              ///< that it hides, mean over all directions
  float visibility = 1;           ///< share of the light from the sky that arrives, mean of the corners' shades
};

/// The line: as few of the centre line's points as keep it within half the branch's radius of all of them, in place and
/// in radius; of a branch without centre line, from one of its farthest two vertices to the other.
/// The radii: all times one factor, so that a ribbon of their width, which turns to the eye, hides what the triangles
/// hide, mean over all directions. (A closed convex surface S hides S / 4; a ribbon from a to b pi / 4 of its area.)
BranchShape branch_shape(const Plant& plant, const Branch& branch);

/// The places of the fewest points, the first and the last among them, so that each point between two that are kept is
/// within `tolerance` of the straight, tapered piece between them: distance and difference of radius together. Pieces
/// span at most 64 points, so the cost is linear.
std::vector<std::uint32_t> fewest_points(std::span<const CentrePoint> line, float tolerance);

}  // namespace manzana::foliage
