#pragma once
/// The one vertex format of everything that stands still: buildings, streets, greens, water.
#include <cstdint>
#include <vector>

#include "culling/vec.h"
#include "scenegraph/column.h"

namespace manzana {

/// What a surface is; the shaders paint each in its own way. In the top byte of CityVertex::colour.
enum class Material : std::uint8_t {
  wall,  ///< uv = (window bays, storeys): whole numbers at the wall's ends and floors; (0, 0) everywhere: a blind wall
  roof,  ///< uv = metres along the eaves, metres up the slope
  asphalt,   ///< uv = metres along, lanes from the left edge: lane lines where v is whole and inside
  junction,  ///< asphalt without lines; uv unused
  pavement,  ///< uv = metres
  path,      ///< footways, cycleways, tracks
  grass,     ///< uv = metres
  park,
  wood,  ///< ground under trees
  farmland,
  sand,
  water,
  concrete,  ///< bridge decks, parapets, blank slabs
  count
};

/// 32 bytes. Position in the frame of its block (BlockFrame), metres; normal in the same frame as signed normalised
/// 10-10-10-2 (GL_INT_2_10_10_10_REV); colour = sRGB red | green << 8 | blue << 16 | Material << 24.
struct CityVertex {
  Vec3 position;
  std::uint32_t normal;
  std::uint32_t colour;
  Vec2 uv;
  std::uint32_t block;
};
static_assert(sizeof(CityVertex) == 32);

/// Triangles, counter-clockwise seen from outside. Indices count from the mesh's first vertex.
struct CityMesh {
  std::vector<CityVertex> vertices;
  std::vector<std::uint32_t> indices;
  /// A row a vertex, alike for a triangle's: what it wears, of Pictures::textures, from 1; 0, and vertices beyond the
  /// last row: nothing. With a texture uv = (right, up) on the picture, whose edges are 0 and 1, and `colour` its mean.
  std::vector<std::uint32_t> textures = {};
};

/// What a vertex of a CityMesh or a StoredMesh wears.
std::uint32_t texture_of(const auto& mesh, std::size_t vertex) {
  return vertex < mesh.textures.size() ? mesh.textures[vertex] : 0;
}

/// The last vertex wears that.
inline void wear(CityMesh& mesh, std::uint32_t texture) {
  if (texture > 0) mesh.textures.resize(mesh.vertices.size(), 0), mesh.textures.back() = texture;
}

/// The same, of a whole layer, that may stay in the file that it was baked into.
struct StoredMesh {
  Column<CityVertex> vertices;
  Column<std::uint32_t> indices, textures;
};

inline std::uint32_t pack_colour(std::uint32_t rgb, Material material) {  // rgb as 0xRRGGBB
  return (rgb >> 16 & 255u) | (rgb & 0xff00u) | (rgb & 255u) << 16 | static_cast<std::uint32_t>(material) << 24;
}
std::uint32_t pack_normal(const Vec3& unit);

}  // namespace manzana
