#pragma once
/// From lanes to closed circuits. Private to build_traffic.
#include <span>
#include <vector>

#include "scenegraph/import/traffic_lanes.h"

namespace manzana {

inline constexpr std::uint32_t kNoLane = ~std::uint32_t{0};

/// Lanes that are used, so that at every junction as many come in as go out: then each is on a closed walk. One-way
/// streets may leave junctions unbalanced; from each junction with too many ways out the shortest path to one with too
/// many ways in is given up (Dijkstra). Paths of that kind exist: what is out of balance decomposes into them.
/// `use`: lanes to begin with, a row a lane.
void balance(std::span<const Lane> lanes, std::uint32_t junctions, std::vector<char>& use);

struct PairingOptions {
  bool left_hand = false;
  std::vector<char> no_crossing;  ///< a row a junction: each takes the next way out, so that ways don't cross
};

/// For each lane in use the lane that follows it, else kNoLane. At each junction the pairing has the least sum of turn
/// costs: straight on, then towards the kerb, then across, and last back; ways that cross cost too. All pairings are
/// tried up to kTryAll lanes, beyond that exchanges of two as long as they help.
std::vector<std::uint32_t> pair_lanes(std::span<const Lane> lanes, const StreetGraph& graph,
                                      const std::vector<char>& use, const PairingOptions& options);
inline constexpr std::size_t kTryAll = 5;

/// Cycles of `next`, each in driving order.
std::vector<std::vector<std::uint32_t>> circuits_of(std::span<const std::uint32_t> next);

}  // namespace manzana
