#pragma once
/// The faces of the street network: what is enclosed by streets that carry traffic.
///   StreetFaces faces(graph);
///   std::uint32_t face = faces.locate(p);     // kNoFace outside all
#include <cstdint>
#include <vector>

#include "scenegraph/import/centroid.h"
#include "scenegraph/import/geos.h"
#include "scenegraph/import/street_graph.h"

namespace manzana {

inline constexpr std::uint32_t kNoFace = ~0U;

struct StreetFace {
  Polygon shape;
  Centroid centroid;
  PlanBox box;
};

/// Rows of the edges that carry traffic and are no dead end: edges at a junction where no other such edge ends are
/// taken away until none is left. Ascending. O(edges).
std::vector<std::uint32_t> enclosing_edges(const StreetGraph& graph);

/// Faces with their index. One thread at a time.
class StreetFaces {
 public:
  /// Nodes and polygonizes the enclosing edges in plan, so that bridges bound faces too. No face when GEOS refuses.
  explicit StreetFaces(const StreetGraph& graph);
  ~StreetFaces();
  StreetFaces(const StreetFaces&) = delete;
  StreetFaces& operator=(const StreetFaces&) = delete;

  /// By centroid (x, then y): the order does not depend on GEOS.
  const std::vector<StreetFace>& faces() const { return faces_; }
  /// Closed faces: a point on a border belongs to the first of its faces. Exact predicates.
  std::uint32_t locate(const Vec2d& p) const;

 private:
  void make_index();

  Geos geos_;
  std::vector<StreetFace> faces_;
  std::vector<Geometry> shapes_;
  std::vector<const GEOSPreparedGeometry*> prepared_;
  std::vector<std::uint32_t> rows_;  // what the tree's items point at
  GEOSSTRtree* tree_ = nullptr;
};

}  // namespace manzana
