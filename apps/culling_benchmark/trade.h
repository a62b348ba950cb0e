#pragma once
/// Speed for accuracy: one city asked box by box, with each volume in each precision, at places where coordinates are
/// small and large. None may miss an object; how many too many they keep, and what they take, is the trade.
///   for (const baselines::PeerInfo& variant : trade_peers()) ...
#include <span>
#include <string>

#include "culling/baselines/peer.h"

namespace manzana::culling_benchmark {

/// sphere-world ... exact-double. Volumes: sphere, box, both (sphere and box), exact (separating axes of the box).
/// Precisions: world (float about L's origin), local (float about the city's middle), relative (double, less the eye,
/// then float), double.
std::span<const baselines::PeerInfo> trade_peers();

/// The same 10 000 objects at L's origin, at UTM's coordinates and at earth-centred ones.
struct TradePlace {
  std::string name, what;
  Vec3d moved_by;
};
std::span<const TradePlace> trade_places();
/// nullptr: no such case.
const TradePlace* find_trade_place(const std::string& name);

}  // namespace manzana::culling_benchmark
