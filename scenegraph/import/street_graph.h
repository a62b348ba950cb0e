#pragma once
/// Streets as a graph: ways are cut where they meet, and carry the height of their surface.
///   StreetGraph graph = build_street_graph(features.streets, issues);
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/import/features.h"

namespace manzana {

/// A street between two junctions (or ends). points = (x, y in plan, height of the surface above ground), at least two,
/// no two equal in plan. from, to: junctions.
struct StreetEdge {
  std::uint32_t from = 0, to = 0;
  std::vector<Vec3d> points;
  std::uint32_t street = 0;  ///< row of the features
  double length = 0;         ///< in plan, metres
};

struct Junction {
  Vec3d position{0, 0, 0};           ///< as StreetEdge::points
  std::vector<std::uint32_t> edges;  ///< those that end here; twice for a loop
};

struct StreetGraph {
  std::vector<StreetFeature> streets;
  std::vector<StreetEdge> edges;  ///< no tunnels
  std::vector<Junction> junctions;
};

/// Two ways meet where they share a node id; a node's place is that of its first occurrence. Neighbours on a way at one
/// place are one node. Bridges rise to kBridgeRise for each layer where they cross something lower, and fall along the
/// connected streets by kRampGrade (street_heights.h). Listed as issues and left without edges: streets with fewer than
/// two different points, without an id for each point, or with a coordinate that is not finite. O(n log n).
StreetGraph build_street_graph(std::vector<StreetFeature> streets, std::vector<Issue>& issues);
inline constexpr double kBridgeRise = 5.5;  // metres: a lorry of 4 m, a deck of 1 m
inline constexpr double kRampGrade = 0.08;

}  // namespace manzana
