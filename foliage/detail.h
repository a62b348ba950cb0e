#pragma once
/// How much of a plant is shown where so many metres may be wrong: the laws of the sources, and ours, as tables.
///   table.details = make_details(plants, Law::ours);
#include <span>

#include "foliage/select.h"

namespace manzana::foliage {

enum class Law : std::uint8_t {
  full,   ///< everything, always: the reference
  ours,   ///< leaf quads while they are larger than a pixel or so, then points; thin branches as ribbons
  prune,  ///< [Gumbau 2009, equation 1] leaf quads only: u = z^(-log_h 2), scaled to keep coverage, times what is seen
          ///< of a cell
  ramp,   ///< the same with the linear ramp that the source runs in its stead
  points_and_lines,  ///< [Deussen 2005, sections 10.3 and 10.4] triangles turn into points, and lines, of which fewer
                     ///< are drawn
  levels  ///< [Gadbem 2011] pairs of mesh and lines, and all leaves as triangles, or all as points, without a
          ///< transition
};
/// full, ours, gumbau, gumbau-ramp, deussen, gadbem; throws std::invalid_argument.
Law law_named(std::string_view name);
const char* name_of(Law law);
std::span<const Law> all_laws();

/// kDetailSteps rows for each plant, over the square of what may be wrong, in metres of its natural size; so they are
/// the same for every view.
std::vector<Detail> make_details(std::span<const PreparedPlant> plants, Law law);

}  // namespace manzana::foliage
