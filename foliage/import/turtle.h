#pragma once
/// A turtle that reads the string of an L-system and leaves a plant behind.  [ABOP, sections 1.3, 1.5 and 1.6.1, and
/// appendix C]
///   F  forward, drawing     f  forward      G  as F, but no corner of a polygon
///   +  -  turn left, right  &  ^  pitch down, up   \  /  roll left, right   |  turn round   $  roll upright
///   [  ]  branch            {  .  }  polygon: F, f and . set its corners    !  thinner      '  next colour
///   ~L ~K a leaf, a petal   %  drops the rest of the branch                 others mean nothing
/// It starts at the foot, heading up. A run of F is a branch; another begins after a bracket (one level up) and after
/// f. Nothing is drawn by F within a polygon. Polygons are leaves.
#include "foliage/import/lsystem.h"
#include "foliage/plant.h"

namespace manzana::foliage {

/// Throws std::runtime_error naming the system, and the symbol's place: brackets or polygons not closed, nested deeper
/// than 10 000, more than 1 000 000 vertices, or nothing drawn.
Plant grow_plant(const LSystem& system);

}  // namespace manzana::foliage
