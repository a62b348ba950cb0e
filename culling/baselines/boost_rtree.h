#pragma once
/// Rows of the peer table (culling/baselines/peer.h): boost::geometry::index::rtree, packed by its bulk constructor.
#include "culling/baselines/peer.h"

namespace manzana::baselines {

/// query(intersects(frustum)): the planes are asked about every node and every object, which is what a predicate of its
/// own can do there; it knows nothing of its parent's answer, so there are no plane masks and no runs.
std::unique_ptr<Peer> make_boost_frustum(const City& city);

/// query(intersects(box of the frustum) && satisfies(planes)): what its manual leads to. `satisfies` is asked about
/// objects only.
std::unique_ptr<Peer> make_boost_box(const City& city);

}  // namespace manzana::baselines
