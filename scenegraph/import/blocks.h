#pragma once
/// City blocks: the faces of the street network, and what stands in for them where there is none.  [Pina 2009, 3.1]
///   BlockPlan plan = find_blocks(graph, centers);     // centers: of all objects, plan
///   plan.of[i] is the block of the i-th centre
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/import/street_faces.h"
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
  double face_size = 1000;             ///< metres: faces with a longer side are open country, cut into fallback blocks
};

/// Faces by noding and polygonizing (GEOS) the edges that carry traffic, without dead ends; bridges bound faces as they
/// lie in plan. A centre in no face falls to an adaptive quadtree of cells (fallback_cells.h), and so do those of a
/// face that is larger than face_size, or has more than 8 fallback_weight objects: it is cut into cells of its own. A
/// half-street belongs to the block on its kerb side, found 1 m beside the middle of its carriageway's edge; where that
/// is in no face, it weighs in the quadtree as one more object. A direction in which nobody drives makes no block where
/// there is one across the street. Every centre gets exactly one block; centres on a border get the first of its faces,
/// in the order of their centroids. Deterministic. Asserts finite centres. O(n log n).
BlockPlan find_blocks(const StreetGraph& graph, std::span<const Vec2d> centers, const BlockOptions& options = {});
/// The same with faces that are there already: those of `graph`.
BlockPlan find_blocks(const StreetGraph& graph, const StreetFaces& faces, std::span<const Vec2d> centers,
                      const BlockOptions& options = {});

}  // namespace manzana
