#pragma once
/// What lies between the houses of a dense town, where nobody has mapped it: not a meadow.
#include <span>
#include <vector>

#include "scenegraph/import/features.h"
#include "scenegraph/import/street_faces.h"

namespace manzana {

/// Of a face's ground under buildings, at which the rest is taken for paved: terraces and closed courts lie above,
/// houses with gardens and slabs on lawns below.
inline constexpr double kPavedCover = 0.3;

/// An area of concrete for each face that is covered so. Greens and squares that are mapped are laid over it.
/// A building counts in the face that holds the middle of its outline's box.
std::vector<AreaFeature> paved_ground(const StreetFaces& faces, std::span<const BuildingFeature> buildings);

}  // namespace manzana
