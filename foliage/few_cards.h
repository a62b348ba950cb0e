#pragma once
/// The coarse level of a crown: few large leaf cards in place of many small ones, scaled so that the crown keeps its
/// coverage. Edge collapse gives nothing on cards. The scale is fitted by drawing, since sqrt(1/u) of Gumbau (2009)
/// overshoots by 11 to 48 per cent: cards overlap.
#include "foliage/plant_mesh.h"

namespace manzana::foliage {

struct Silhouette {
  const Image& leaf;
  PlantSize size;
};

/// Share of the plant's bounding rectangle (2 r wide, from the ground to the top) that it covers, seen from the side
/// at `angle` radians about the axis; texels of leaves with alpha below one half are holes. Cost: the pixels, 96 x 96.
float side_coverage(const PlantMesh& mesh, const Silhouette& silhouette, float angle);

/// Triangles joined by common corners are a card, or a leaf of a few triangles. At most `most` of `leaves`' cards,
/// spread evenly over the crown, each moved to the middle of those it stands for, and all scaled so that with `bark`
/// the coverage is that of `fine`. Deterministic.
MeshPart few_cards(const PlantMesh& fine, const MeshPart& bark, const Silhouette& silhouette, std::size_t most);

/// A share of the cards, drawn by hash, each in its place and scaled about its middle to the same end.
MeshPart thinned_cards(const PlantMesh& fine, const Silhouette& silhouette, float share);

/// How many cards there are.
std::size_t count_cards(const MeshPart& leaves);

}  // namespace manzana::foliage
