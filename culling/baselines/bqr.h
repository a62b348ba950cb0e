#pragma once
/// The product itself, seen through the peers' interface.
#include "culling/baselines/peer.h"

namespace manzana::baselines {

std::unique_ptr<Peer> make_bqr(const City& city);

}  // namespace manzana::baselines
