#pragma once
/// Cars that drive on the half-streets round the blocks, each attached to the block on its right.  [Pina
/// 2009, 3.2, 4.2]
///   Streets streets = make_streets(make_city(*find_case("C2"), 1), 10'000, 1);
///   cars_of_block(streets.traffic, block, ticks(seconds), cars);           // scenegraph/traffic.h
/// A half-street runs clockwise along one side of its block. Where four blocks meet, by chance all cars turn round
/// their own block or all go straight on to the next one's half-street; elsewhere they turn. So the half-streets fall
/// into closed circuits, and every car keeps one speed for ever.
#include "culling/baselines/city.h"
#include "scenegraph/traffic.h"

namespace manzana::paper {

inline constexpr double kCarSpeed = 10;  ///< m/s: "a fixed amount each frame"

struct Streets {
  /// Every block encloses its half-streets too, and has one object more, its last: they themselves, without triangles.
  /// A structure that finds single objects answers with it when cars of the block may be seen.
  baselines::City city;
  Traffic traffic;
  std::uint32_t street_row(std::uint32_t block) const { return city.first[block + 1] - 1; }
};

/// Cars are put at random places of all half-streets; they may stand in each other, as 10 000 must on those of C2.
Streets make_streets(const baselines::City& city, std::uint32_t cars, std::uint64_t seed);

}  // namespace manzana::paper
