#pragma once
/// How much of a plant is shown at a distance: the laws of the sources, and ours, as tables over the squared distance.
///   table.details = make_details(plants, {.focal_px = height_px / (2 * std::tan(fovy / 2))});
#include <span>

#include "foliage/select.h"

namespace manzana::foliage {

enum class Law : std::uint8_t {
  full,  ///< everything, always: the reference
  ours,  ///< leaf quads while they are larger than a pixel or so, then points; thin branches as ribbons
  prune  ///< [Gumbau 2009, equation 1] leaf quads only, u = z^(-log_h 2), scaled to keep coverage
};
Law law_named(std::string_view name);  ///< full, ours, gumbau; throws std::invalid_argument
const char* name_of(Law law);

struct DetailOptions {
  double focal_px = 1000;  ///< height of the picture over the tangent of its full angle: pixels of 1 m at 1 m
  double error_px = 1;     ///< what is smaller may be wrong
  Law law = Law::ours;
};

/// kDetailSteps rows for each plant; a distance is from a tree's middle, or a cell's, over the tree's scale. Throws
/// std::invalid_argument for options that are not positive and finite.
std::vector<Detail> make_details(std::span<const PreparedPlant> plants, const DetailOptions& options);

}  // namespace manzana::foliage
