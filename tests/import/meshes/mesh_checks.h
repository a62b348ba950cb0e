#pragma once
/// What every mesh must hold, and measures of meshes that the makers don't share.
#include <cstdint>
#include <vector>

#include "scenegraph/import/meshes.h"

namespace checks {
using namespace manzana;

/// splitmix64, so that failures repeat on every machine.
struct Random {
  std::uint64_t state;
  std::uint64_t bits();
  double unit();
  double between(double low, double high) { return low + (high - low) * unit(); }
  int whole(int low, int high) { return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1)); }
};

Vec3 unpack_normal(std::uint32_t packed);
Material material(const CityVertex& vertex);

/// Finite vertices, unit normals, indices in range, triangles whose geometric normal agrees with their vertices'.
/// Returns what is wrong, or nothing.
std::string fault(const CityMesh& mesh);

/// Of the closed body, by the divergence theorem, m3.
double volume(const CityMesh& mesh);
double area(const CityMesh& mesh, Material kind);  ///< m2 of the triangles whose first corner has it
/// Directed edges without a partner in the other direction, corners equal within `tolerance`.
std::size_t open_edges(const CityMesh& mesh, double tolerance);
/// Closes a body that stands on the ground with the bottom of its footprint.
void add_bottom(CityMesh& mesh, const std::vector<Polygon>& footprint, double z);

Polygon rectangle(double x, double y, double width, double depth);
/// Random radii about a centre at equal angles: star-shaped, not convex.
std::vector<Vec2d> star(Random& random, const Vec2d& center, int corners, double least, double most);
std::vector<Vec2d> turned(std::vector<Vec2d> ring, double angle);

}  // namespace checks
