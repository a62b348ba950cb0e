#pragma once
/// Triangles of a plant as the quads that are drawn (PlantQuad, foliage/prepared_plant.h): two triangles that share an
/// edge are one quad.
#include <span>

#include "foliage/prepared_plant.h"

namespace manzana::foliage {

/// What all quads of a branch or a leaf have in common.
struct QuadTraits {
  Vec3 anchor{0};
  std::uint32_t level = 0;  ///< the branch's; more than 3 is 3
};

/// Appends to `out`. `indices`: three for each triangle. Each triangle is in one quad, its winding kept; two are paired
/// only where they share both vertices of an edge and agree about the front, so that nothing bends but the quad. Tubes
/// and cards pair up wholly. Cost n log n.
void add_quads(const MeshPart& part, std::span<const std::uint32_t> indices, const QuadTraits& traits,
               std::vector<PlantQuad>& out);

}  // namespace manzana::foliage
