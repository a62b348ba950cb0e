#pragma once
/// Shapes of houses, trees and cars with exactly as many triangles as asked for, so that a city said to have 1 688 023
/// triangles can be drawn with 1 688 023.
///   Mesh house = make_object(ObjectKind::building, box, 640, row);
/// A shape begins with the few triangles that show what it is; then its triangles are halved, one after the other, at
/// the middle of their longest edge, until there are enough: none is degenerate, all lie inside the box.
#include <cstdint>
#include <vector>

#include "culling/baselines/city.h"

namespace manzana::paper {

/// Position in L, metres (of a car: on its wheels, y forward); colour = sRGB red | green << 8 | blue << 16 | 255 << 24,
/// light and shade included.
struct Corner {
  Vec3 position;
  std::uint32_t colour;
};
static_assert(sizeof(Corner) == 16);

/// Three indices a triangle, counter-clockwise from outside.
struct Mesh {
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;
  std::size_t triangles() const { return indices.size() / 3; }
};

/// Halves triangles, round after round, until there are so many; keeps the first so many of a mesh that has more.
void refine(Mesh& mesh, std::size_t triangles);

/// `seed` chooses colour and roof. Inside the box, but for its rounding to float.
Mesh make_object(baselines::ObjectKind kind, const culling::BoxD& box, std::size_t triangles, std::uint64_t seed);

/// The saloon of manzana-walkthrough at the level that comes next below, refined. Paint is white: each car tints it.
/// Takes 0.1 s.
Mesh make_car(std::size_t triangles);
/// It drawn out to a box, along the longer side of that, and painted.
Mesh parked_car(Mesh car, const culling::BoxD& box, std::uint64_t seed);

}  // namespace manzana::paper
