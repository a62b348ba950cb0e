#pragma once
/// Cars that drive on the half-streets round the blocks, each attached to the block on its right.  [Pina
/// 2009, 3.2, 4.2]
///   Traffic traffic = make_traffic(city, 10'000, 1);
///   City wider = with_streets(city, traffic);
///   cars_of_block(traffic, block, ticks(seconds), cars);           // scenegraph/traffic.h
/// A half-street runs clockwise along one side of its block. Where four blocks meet, by chance all cars turn round
/// their own block or all go straight on to the next one's half-street; elsewhere they turn. So the half-streets fall
/// into closed circuits, and every car keeps one speed for ever.
#include "culling/baselines/city.h"
#include "scenegraph/traffic.h"

namespace manzana::paper {

inline constexpr double kCarSpeed = 10;  ///< m/s: "a fixed amount each frame"

/// Cars are put at random places of all half-streets; they may stand in each other, as 10 000 must on those of C2.
/// Half-streets do not depend on how many there are.
Traffic make_traffic(const baselines::City& city, std::uint32_t cars, std::uint64_t seed);

/// The city with blocks that enclose their half-streets too, and with one object more in each, its last: they
/// themselves, without triangles. A structure that finds single objects answers with it when cars of the block may be
/// seen.
baselines::City with_streets(const baselines::City& city, const Traffic& traffic);
inline std::uint32_t street_row(const baselines::City& city, std::uint32_t block) { return city.first[block + 1] - 1; }

}  // namespace manzana::paper
