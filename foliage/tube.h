#pragma once
/// The mesh of a stem, and its row in a plant.
#include <span>

#include "foliage/stems.h"

namespace manzana::foliage {

/// A tube round at least two points, that ends in a point; one ring of vertices at each other. `length` metres say how
/// often the bark image repeats along it, `bark_repeats` how often round it. The seam's vertices are double, for the
/// bark's sake.
void add_tube(MeshPart& bark, std::span<const StemPoint> points, float length, int sides, float bark_repeats);

/// The stem's row: a tube round its points, and they as its centre line. The parents' rows are there already.
void add_branch(Plant& plant, const Stem& stem, std::span<const StemPoint> points);

}  // namespace manzana::foliage
