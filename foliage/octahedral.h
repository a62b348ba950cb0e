#pragma once
/// Directions over the whole sphere as a square grid: corners are vertices, so a direction lies in one triangle of
/// vertices and its weights are barycentric: none negative, sum 1, continuous everywhere, exact at a vertex. The
/// paper's nearest three cameras have none of that (numerics.md 10.2).  [Cigolle et al. 2014, "A survey of efficient
/// representations for independent unit vectors"]
#include <array>
#include <cstdint>

#include "culling/vec.h"

namespace manzana::foliage {

/// Vertex (i, j) of a grid of `side` x `side` vertices, row j: a unit vector from the plant's middle. side >= 2. The
/// rim is the lower pole's folded square: vertices there come in pairs.
Vec3d grid_direction(std::uint32_t side, std::uint32_t i, std::uint32_t j);

/// Weights are whole 256ths, so that a GPU and a CPU agree to the bit; their sum is 256.
struct GridWeights {
  std::array<std::uint32_t, 3> vertex{};  ///< j * side + i
  std::array<std::uint32_t, 3> weight{256, 0, 0};
};

/// Of a direction of any length, floats as they are (no division decides); of 0 or not finite: the upper pole. Places
/// are rounded to whole 256ths of a step, so a vertex that is meant has weight 256. Parts below 2^-100 count as 0, a
/// sum of parts from 2^100 on as not finite. side <= 257.
GridWeights grid_weights(std::uint32_t side, const Vec3& direction);

}  // namespace manzana::foliage
