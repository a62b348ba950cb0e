#pragma once
/// What streets and areas share when they lay ground: colours, heights, and polygons cut into cells.
#include "scenegraph/import/meshes.h"
#include "scenegraph/import/plan_geometry.h"

namespace manzana {

/// The colour of a ground material, packed.
std::uint32_t ground_colour(Material material);

/// Heights above ground are fixed and a few millimetres apart, so that what overlaps never flickers: reversed float
/// depth tells 0.12 mm apart at 1 km [numerics 7.2]. From below: wood floor, farmland, grass, park, sand, water,
/// pavement (areas, 20 to 50 mm), paths (60 mm), squares and pavements (76, 80 mm), carriageways (from 120 mm).
double area_height(Material kind);

/// Appends the polygon in pieces of at most kSurfacePiece a side (twice kMostCells times that for larger ones: then in
/// kMostCells pieces a side), `height` above ground. What cannot be cut is listed.
struct AreaCover {
  std::string where;
  Material material = Material::grass;
  double height = 0;
};
void append_area(std::vector<SurfacePiece>& pieces, const Geos& geos, const Polygon& shape, const AreaCover& cover,
                 std::vector<Issue>& issues);
inline constexpr int kMostCells = 128;

/// Grows one piece; positions are given in plan.
class PieceBuilder {
 public:
  explicit PieceBuilder(const Vec2d& center) { piece_.center = center; }
  std::uint32_t vertex(const Vec3d& position, const Vec3d& normal, std::uint32_t colour, const Vec2d& uv);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  bool empty() const { return piece_.plan.indices.empty(); }
  SurfacePiece take() { return std::move(piece_); }

 private:
  SurfacePiece piece_;
};

}  // namespace manzana
