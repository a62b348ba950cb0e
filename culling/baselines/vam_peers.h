#pragma once
/// Rows of the peer table (culling/baselines/peer.h): VAMSplit R-trees.
#include "culling/baselines/peer.h"

namespace manzana::baselines {

/// A page holds 16 objects; objects of crossing pages are tested.
std::unique_ptr<Peer> make_vam16(const City& city);

/// A page holds `blocks` blocks; a page that is not outside is accepted with all objects of its blocks.
template <std::uint32_t blocks>
std::unique_ptr<Peer> make_vam_blocks(const City& city);

extern template std::unique_ptr<Peer> make_vam_blocks<1>(const City&);
extern template std::unique_ptr<Peer> make_vam_blocks<2>(const City&);
extern template std::unique_ptr<Peer> make_vam_blocks<4>(const City&);
extern template std::unique_ptr<Peer> make_vam_blocks<6>(const City&);
extern template std::unique_ptr<Peer> make_vam_blocks<8>(const City&);

}  // namespace manzana::baselines
