#pragma once
/// Leaf triangles as the quads that are drawn: a card's two triangles are one quad, so that a card costs four vertices
/// in place of six, and a quad knows the petiole about which it is scaled.
#include "foliage/prepared_plant.h"

namespace manzana::foliage {

struct LeafQuads {
  std::vector<PlantQuad> quads;
  std::vector<Run> leaves;  ///< of quads; one run a terminal, in the plant's order
};

/// Paired by add_quads() (foliage/plant_quads.h), vertices that are alike made one before; each triangle is in one
/// quad. The anchor is the point of the leaf's edges that is nearest to its branch's line; of a leaf without a branch,
/// the middle of the edge with v nearest 1, the foot of the picture.
LeafQuads leaf_quads(const Plant& plant);

inline bool is_triangle(const PlantQuad& quad) { return quad.corners[2].position == quad.corners[3].position; }

double quad_area(const PlantQuad& quad);  ///< m2, one side, holes and all

}  // namespace manzana::foliage
