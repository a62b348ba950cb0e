#include <algorithm>
#include <array>

#include "culling/baselines/bqr.h"
#include "culling/baselines/bqr_paper.h"
#include "culling/baselines/linear.h"
#include "culling/baselines/peer.h"

namespace manzana::baselines {
namespace {

constexpr std::array kPeers{
    PeerInfo{"bqr", "the BqR-Tree of this library", Grain::object, true, make_bqr},
    PeerInfo{"bqr-paper", "the BqR-Tree of the paper, written plainly, scalar", Grain::block, true, make_bqr_paper},
    PeerInfo{"none", "no culling: everything, always", Grain::object, true, make_none},
    PeerInfo{"linear", "box after box, plane after plane, scalar", Grain::object, true, make_linear},
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
