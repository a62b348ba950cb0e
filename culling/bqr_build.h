#pragma once
/// The builder's choices, for those whom build_bqr_tree's own do not suit.
///   BqrTree tree = build_bqr_tree(blocks, objects, {.order = ObjectOrder::given});
/// A Z-curve makes the tightest packets and the longest runs. Who draws runs as they come and lets the last of two
/// equally deep surfaces win keeps the order that the objects were given in: then a picture does not tell of the tree.
#include "culling/bqr_tree.h"

namespace manzana::culling {

/// Of the objects within a block.
enum class ObjectOrder : std::uint8_t { z_curve, given };

struct BqrBuildOptions {
  ObjectOrder order = ObjectOrder::z_curve;
};

/// As build_bqr_tree of two, but for the options.
BqrTree build_bqr_tree(std::span<const BlockVolume> blocks, const BlockObjects& objects,
                       const BqrBuildOptions& options);

}  // namespace manzana::culling
