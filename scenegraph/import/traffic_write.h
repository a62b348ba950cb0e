#pragma once
/// From a plan of rides and slots to Traffic. Private to build_traffic.
#include "scenegraph/import/traffic_signals.h"
#include "scenegraph/local_frame.h"

namespace manzana {

struct TrafficPlan {
  std::vector<Lane> lanes;
  std::vector<Ride> rides;                                        ///< circuit by circuit, in driving order
  std::vector<std::pair<std::uint32_t, std::uint32_t>> circuits;  ///< runs of rides
  Slots slots;
  std::uint32_t cars = 0;  ///< wanted
};

struct Terrain;

/// Lanes are laid on the ground, on a terrain where it is not null; cars are spread over the slots by a hash of the
/// seed. No index of blocks yet.
Traffic write_traffic(const LocalFrame& frame, const TrafficPlan& plan,
                      std::span<const std::uint32_t> half_street_blocks, std::uint64_t seed, const Terrain* terrain);

/// Phase a tick for a lap of so many ticks: 2^64 / ticks, the whole part and 32 bits more, rounded down.
void set_step(Circuit& circuit, std::uint64_t ticks_a_lap);

}  // namespace manzana
