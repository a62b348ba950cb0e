#pragma once
/// A bounding volume hierarchy as it is done today: eight children to a node, their boxes in columns and tested at
/// once, only against the planes that the parent crosses; what is inside becomes a run untested.
#include "culling/baselines/peer.h"

namespace manzana::baselines {

/// Packed: all nodes are full but the last of each level, all objects lie equally deep. Built top down, by splits at
/// the median along the longest side of the centres.
std::unique_ptr<Peer> make_bvh8(const City& city);

}  // namespace manzana::baselines
