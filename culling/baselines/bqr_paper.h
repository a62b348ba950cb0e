#pragma once
/// The BqR-Tree as its paper has it, written plainly: one node at a time, against one plane after the other (those that
/// the node above reaches beyond), whole blocks.
/// [Pina, Cerezo, Seron: Bq-Rtree (2009), section 3]
#include "culling/baselines/peer.h"

namespace manzana::baselines {

/// An adaptive quadtree over the blocks' centres; a sphere a node, a sphere and a box a leaf, one block a leaf.
std::unique_ptr<Peer> make_bqr_paper(const City& city);

}  // namespace manzana::baselines
