#pragma once
/// No tree: nothing asked at all, or every object asked in turn.
#include "culling/baselines/peer.h"

namespace manzana::baselines {

/// Takes everything.
std::unique_ptr<Peer> make_none(const City& city);
/// One box after the other, its farthest corner against plane after plane, in float.
std::unique_ptr<Peer> make_linear(const City& city);
/// Sixteen spheres at once against all planes, in float.
std::unique_ptr<Peer> make_linear_simd(const City& city);

}  // namespace manzana::baselines
