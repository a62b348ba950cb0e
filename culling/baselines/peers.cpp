#include <algorithm>
#include <array>

#include "culling/baselines/boost_rtree.h"
#include "culling/baselines/bqr.h"
#include "culling/baselines/bqr_paper.h"
#include "culling/baselines/bvh8.h"
#include "culling/baselines/linear.h"
#include "culling/baselines/osg_peers.h"
#include "culling/baselines/peer.h"
#include "culling/baselines/vam_peers.h"

namespace manzana::baselines {
namespace {

constexpr std::array kPeers{
    PeerInfo{"bqr", "the BqR-Tree of this library", Grain::object, true, make_bqr},
    PeerInfo{"bqr-paper", "the BqR-Tree of the paper, written plainly, scalar", Grain::block, true, make_bqr_paper},
    PeerInfo{"none", "no culling: everything, always", Grain::object, true, make_none},
    PeerInfo{"linear", "box after box, plane after plane, scalar", Grain::object, true, make_linear},
    PeerInfo{"linear-simd", "sphere after sphere, sixteen at once", Grain::object, true, make_linear_simd},
    PeerInfo{"vam16", "VAMSplit R-tree, 16 objects a page, scalar", Grain::object, true, make_vam16},
    PeerInfo{"vam-block1", "VAMSplit R-tree, whole pages of 1 block", Grain::block, true, make_vam_blocks<1>},
    PeerInfo{"vam-block2", "VAMSplit R-tree, whole pages of 2 blocks", Grain::block, true, make_vam_blocks<2>},
    PeerInfo{"vam-block4", "VAMSplit R-tree, whole pages of 4 blocks", Grain::block, true, make_vam_blocks<4>},
    PeerInfo{"vam-block6", "VAMSplit R-tree, whole pages of 6 blocks", Grain::block, true, make_vam_blocks<6>},
    PeerInfo{"vam-block8", "VAMSplit R-tree, whole pages of 8 blocks", Grain::block, true, make_vam_blocks<8>},
    PeerInfo{"bvh8", "flat hierarchy, eight boxes a node, plane masks, runs", Grain::object, true, make_bvh8},
    PeerInfo{"boost-frustum", "Boost.Geometry R-tree, asked about a frustum", Grain::object, true, make_boost_frustum},
    PeerInfo{"boost-box", "Boost.Geometry R-tree, asked about the frustum's box", Grain::object, true, make_boost_box},
    PeerInfo{"osg", "OpenSceneGraph's CullVisitor over a quadtree", Grain::object, kOsg, make_osg},
    PeerInfo{"osg-stack", "the same tree walked by hand with its CullStack, runs", Grain::object, kOsg, make_osg_stack},
};

}  // namespace

std::span<const PeerInfo> peers() { return kPeers; }

const PeerInfo* find_peer(std::string_view slug) {
  const auto* found = std::find_if(kPeers.begin(), kPeers.end(), [&](const PeerInfo& p) { return p.slug == slug; });
  return found == kPeers.end() ? nullptr : found;
}

std::vector<std::uint32_t> taken(const Peer& peer, const Answer& answer) {
  const auto order = peer.order();
  std::vector<std::uint32_t> rows;
  for (const auto& run : answer.runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) rows.push_back(order.empty() ? i : order[i]);
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace manzana::baselines
