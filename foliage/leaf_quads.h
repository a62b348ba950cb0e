#pragma once
/// Leaf triangles as the quads that are drawn: a card's two triangles are one quad, so that a card costs four vertices
/// in place of six, and a quad knows the petiole about which it is scaled.
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

struct LeafQuads {
  std::vector<PlantQuad> quads;
  std::vector<Run> leaves;  ///< of quads; one run a terminal, in the plant's order
};

/// Two triangles of a terminal are one quad where they share an edge with all that its ends carry, and wind alike; any
/// other is a quad whose last corners are one. Never more quads than triangles; the surface is the same to the bit.
/// The anchor is the point of the leaf's edges that is nearest to its branch's line; of a leaf without a branch, the
/// middle of the edge with v nearest 1, the foot of the picture.
LeafQuads leaf_quads(const Plant& plant);

inline bool is_triangle(const PlantQuad& quad) { return quad.corners[2].position == quad.corners[3].position; }

}  // namespace manzana::foliage
