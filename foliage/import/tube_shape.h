#pragma once
/// The centre line of a connected piece of surface, and how much the piece is a tube round it.
#include <cstdint>
#include <span>
#include <vector>

#include "foliage/plant.h"

namespace manzana::foliage {

struct TubeShape {
  std::vector<CentrePoint> line;  ///< at least two points; either end first
  float roundness = 0;            ///< 1: every triangle faces away from the line; 0: they lie along it, as a card's do
  float slenderness = 0;          ///< how far the line reaches from its end, over its mean radius
  int openings = 0;               ///< loops of edges that have one triangle only
  float area = 0;
};

/// Slices: what is the same number of edges away from an end. That is exact for rings of vertices, whatever way the
/// tube bends, and fair for other surfaces. `corners` are numbers of positions, joined by place.
TubeShape tube_shape(std::span<const Vec3> positions, std::span<const std::uint32_t> corners,
                     std::span<const std::uint32_t> triangles);

}  // namespace manzana::foliage
