#pragma once
/// A light sway, done in the vertex shaders (foliage/shaders/sway.glsl): of near trees branch by branch, of mosaics as
/// their trunk bends; groves stand still. What culls must leave room for it.
#include "culling/vec.h"

namespace manzana::foliage {

/// As a share of a tree's height, to every side, at strength 1: 0.012 of the trunk and 0.006 of its boughs.
inline constexpr double kMostSway = 0.018;

struct Wind {
  Vec3 towards{0, 0, 0};  ///< level, of length 0 to 1: its strength; 0: no wind
  float seconds = 0;
};

}  // namespace manzana::foliage
