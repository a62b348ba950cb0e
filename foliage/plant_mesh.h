#pragma once
/// A plant in metres while it is built: bark and leaf triangles apart, full floats. finish_level() makes of it what is
/// drawn. Shared by the generator and the importers.
#include <array>
#include <span>

#include "foliage/plant_model.h"

namespace manzana::foliage {

struct MeshVertex {
  Vec3 position, normal;  ///< metres, z up; unit
  Vec2 uv;                ///< as in PlantVertex, in [0, kUvRange]
  float shade = 1;        ///< ambient light that arrives
};

struct MeshPart {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::size_t triangles() const { return indices.size() / 3; }
};

struct PlantMesh {
  MeshPart bark, leaves;
};

/// The plant's size: metres from the foot to the top, and from the axis to the farthest vertex.
struct PlantSize {
  float height = 0, radius = 0;
};

void add_quad(MeshPart& part, const std::array<MeshVertex, 4>& corners);  ///< 0-1-2, 0-2-3

/// Of both parts. Heights are from z = 0.
PlantSize measure(const PlantMesh& mesh);

/// Normals of leaves bent away from the crown's middle, and shade by how much foliage light from the sky passes.
/// Once for the finest level; coarser ones take their light from its grid.
class CrownLight {
 public:
  explicit CrownLight(const MeshPart& leaves);
  void apply(PlantMesh& mesh) const;

 private:
  float ambient(const Vec3& at) const;
  Vec3 bent_normal(const MeshVertex& vertex) const;

  static constexpr int kCells = 20;  // along each side
  Vec3 low_{0}, cell_{1};
  std::vector<float> density_;  // leaf area by volume, 1/m
};

/// Shade and normal from the nearest vertex of `fine`: corners of large cards stick out of the crown, and must not
/// shine for that. Cost: the product of both counts.
void take_light(MeshPart& coarse, const MeshPart& fine);

/// Scaled to the size's unit cylinder; what sticks out of it is cut back to its surface.
PlantLevel finish_level(const PlantMesh& mesh, const PlantSize& size, float min_radius_px);

/// Signed normalised 10-10-10-2 of a unit vector.
std::uint32_t pack_normal(const Vec3& normal);
/// Unsigned normalised, of [0, kUvRange]; cut off there.
std::uint16_t pack_uv(float v);
/// Unsigned normalised; cut off.
std::uint8_t pack_shade(float v);

}  // namespace manzana::foliage
