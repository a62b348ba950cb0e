#pragma once
/// Circuits, signals and cars from the street graph; see scenegraph/traffic.h for what comes out.
#include <span>

#include "scenegraph/import/street_graph.h"
#include "scenegraph/local_frame.h"
#include "scenegraph/traffic.h"

namespace manzana {

struct Terrain;

struct TrafficOptions {
  int cars = -1;  ///< -1: by the length of the streets, at most 20 000
  bool left_hand = false;
  std::uint64_t seed = 1;
  const Terrain* terrain = nullptr;  ///< null: level
};

/// Edges that carry traffic get a half-street each way (one-way streets: one), as far as closed circuits can be made of
/// them; at each junction the pairing prefers going straight on. Every way over a junction has a slot in a cycle of all
/// junctions that no crossing way shares, and profiles are timed so that cars come in their slots. Cars never meet:
/// that is proved for one cycle with a car at every place, and streets where it does not hold are left without traffic.
/// `half_street_blocks`: 2 rows an edge, along its points and against them (BlockPlan::half_streets); `blocks`: how
/// many. At most `cars` cars, and no more than fit.
Traffic build_traffic(const LocalFrame& frame, const StreetGraph& graph,
                      std::span<const std::uint32_t> half_street_blocks, std::uint32_t blocks,
                      const TrafficOptions& options);

}  // namespace manzana
