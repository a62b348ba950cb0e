#pragma once
/// From features to triangles, in the frame of a block. Footprints with holes are triangulated by GEOS (constrained
/// Delaunay, in metres); walls and roofs are our own.
/// Each function appends to `mesh`, with CityVertex::block left 0 for the caller to fill in; what can't be made is
/// listed in `issues` and appends nothing.
#include "scenegraph/import/features.h"
#include "scenegraph/import/street_graph.h"
#include "scenegraph/mesh.h"

namespace manzana {

struct Terrain;

/// Where meshes are laid: both frames, for ground_point().
struct Site {
  const LocalFrame& frame;
  const BlockFrame& block;
  const Terrain* terrain = nullptr;  ///< null: level
};

/// Walls (with window bays and storeys), roof, and a floor where min_height > 0. Self-crossing outlines are mended by
/// GEOS (MakeValid) with an issue; roof shapes that the outline does not allow fall back to the nearest that it does.
void append_building(CityMesh& mesh, const Site& site, const BuildingFeature& building, std::vector<Issue>& issues);

/// The surfaces as they are. A part that is closed is turned outward where it is inside out; one that is not is seen
/// from both sides. Upright walls of buildings that are about rectangular get window bays and storeys.
void append_construction(CityMesh& mesh, const Site& site, const ConstructionFeature& work, std::vector<Issue>& issues);

/// Half an edge's length at a time is not enough for long streets: pieces are at most this long, metres.
inline constexpr double kSurfacePiece = 150;

/// One piece of ground to be laid: part of a street, of a junction, or of an area. Its centre decides its block.
struct SurfacePiece {
  Vec2d center{0, 0};
  CityMesh plan;                 ///< position = (x, y relative to `center`, height above ground); block unset
  std::uint32_t attributes = 0;  ///< row of what it is a piece of
};

/// Carriageways with lane lines, pavements beside them, junctions, bridges with deck, parapets and ramps.
std::vector<SurfacePiece> street_pieces(const StreetGraph& graph, std::vector<Issue>& issues);
/// Areas, cut into cells of kSurfacePiece, mended where they cross themselves.
std::vector<SurfacePiece> area_pieces(std::span<const AreaFeature> areas, std::vector<Issue>& issues);

/// Trees of the areas with trees_per_ha > 0: blue noise, the same for a seed; none on streets, buildings or water.
std::vector<TreeFeature> scatter_trees(const CityFeatures& features, std::uint64_t seed);

}  // namespace manzana
