#pragma once
/// A plant's triangles in metres: bark and leaves apart, full floats; and how what is drawn packs them.
#include <array>
#include <cstdint>
#include <vector>

#include "culling/vec.h"

namespace manzana::foliage {

inline constexpr float kUvRange = 8;  // bark repeats up to eight times

struct MeshVertex {
  Vec3 position, normal;  ///< metres, z up; unit
  Vec2 uv;                ///< in [0, kUvRange]; pictures repeat
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

/// Signed normalised 10-10-10-2 of a unit vector.
std::uint32_t pack_normal(const Vec3& normal);
Vec3 unpack_normal(std::uint32_t bits);
/// Unsigned normalised, of [0, kUvRange]; cut off there.
std::uint16_t pack_uv(float v);
/// Unsigned normalised; cut off.
std::uint8_t pack_shade(float v);

}  // namespace manzana::foliage
