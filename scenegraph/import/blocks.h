#pragma once
/// City blocks: the faces of the street network, and what stands in for them where there is none.  [Pina 2009, 3.1]
///   BlockPlan plan = find_blocks(graph, centers);     // centers: of all objects, plan
///   plan.of[i] is the block of the i-th centre
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/import/street_graph.h"

namespace manzana {

struct BlockGround {
  Vec2d center{0, 0};  ///< geometric centre: centroid of the face [numerics 5], or of the fallback cell
  bool fallback = false;
};

struct BlockPlan {
  std::vector<BlockGround> blocks;          ///< only those that have an object or a half-street
  std::vector<std::uint32_t> of;            ///< a row a centre
  std::vector<std::uint32_t> half_streets;  ///< 2 rows an edge of the graph: along its points, then against them
};

struct BlockOptions {
  bool left_hand_traffic = false;
  std::uint32_t fallback_weight = 64;  ///< objects in a fallback block at most
  double fallback_size = 400;          ///< metres, the longest side of a fallback block
  double face_size = 1000;             ///< faces with a longer side are open country: cut into fallback blocks
};

/// Faces by noding and polygonizing (GEOS) the edges that carry traffic, without dead ends. A centre in no face, or in
/// a face larger than face_size, falls to an adaptive quadtree of cells. A half-street belongs to the block on its kerb
/// side. Every centre gets exactly one block; centres on a border get the face found first. Deterministic.
BlockPlan find_blocks(const StreetGraph& graph, std::span<const Vec2d> centers, const BlockOptions& options = {});

}  // namespace manzana
