#include "scenegraph/draw/city_layer.h"

#include <algorithm>
#include <cmath>

#include "manzana_draw_shaders.h"
#include "scenegraph/draw/photo_layer.h"

namespace manzana::draw {
namespace {

Material material_of(const CityVertex& vertex) { return static_cast<Material>(vertex.colour >> 24); }

// Flat values of a triangle are those of its last vertex.
Paint paint_at(const CityMesh& mesh, std::size_t triangle) {
  if (texture_of(mesh, mesh.indices[triangle + 2]) > 0) return Paint::picture;
  return paint_of(material_of(mesh.vertices[mesh.indices[triangle + 2]]));
}

gl::Program make_paint(std::string_view name, std::string_view fragment, const PhotoPieces& photo,
                       bool fading = false) {
  using namespace shaders;
  const std::string_view share = fading ? fade_glsl : whole_glsl;
  return gl::make_program(name, {version_glsl, frame_layout_glsl, frame_glsl, light_glsl, seed_glsl, city_vert},
                          {version_glsl, frame_layout_glsl, frame_glsl, noise_glsl, light_glsl, share_glsl, photo[0],
                           photo[1], city_glsl, share, fragment});
}

gl::Program make_picture_paint(std::string_view name, bool fading = false) {
  using namespace shaders;
  return gl::make_program(name, {version_glsl, frame_layout_glsl, frame_glsl, light_glsl, worn_vertex_glsl, city_vert},
                          {version_glsl, frame_layout_glsl, frame_glsl, light_glsl, share_glsl, city_glsl,
                           worn_layout_glsl, worn_glsl, fading ? fade_glsl : whole_glsl, picture_frag});
}

}  // namespace

Paint paint_of(Material material) {
  switch (material) {
    case Material::wall:
      return Paint::facade;
    case Material::roof:
      return Paint::roof;
    case Material::asphalt:
    case Material::junction:
      return Paint::road;
    case Material::water:
      return Paint::water;
    default:
      return Paint::ground;
  }
}

PaintPrograms make_paint_programs(bool photo, bool pictures) {
  const PhotoPieces pieces = photo_pieces(photo);
  return {make_paint("facade", shaders::facade_frag, pieces), make_paint("roof", shaders::roof_frag, pieces),
          make_paint("road", shaders::road_frag, pieces),     make_paint("water", shaders::water_frag, pieces),
          make_paint("ground", shaders::ground_frag, pieces), pictures ? make_picture_paint("picture") : gl::Program()};
}

PaintPrograms make_fading_programs(bool pictures) {
  const PhotoPieces none = photo_pieces(false);
  PaintPrograms programs;
  const auto make = [&](Paint paint, std::string_view name, std::string_view fragment) {
    programs[static_cast<std::size_t>(paint)] = make_paint(name, fragment, none, true);
  };
  make(Paint::facade, "fading facade", shaders::facade_frag);
  make(Paint::roof, "fading roof", shaders::roof_frag);
  make(Paint::ground, "fading concrete", shaders::ground_frag);
  if (pictures) programs[static_cast<std::size_t>(Paint::picture)] = make_picture_paint("fading picture", true);
  return programs;
}

PaintedIndices sort_by_paint(const CityMesh& mesh, std::span<const std::uint32_t> index_first) {
  PaintedIndices sorted;
  sorted.indices.reserve(mesh.indices.size());
  for (std::size_t p = 0; p < kPaints; ++p) {
    auto& first = sorted.first[p];
    first.reserve(std::max<std::size_t>(index_first.size(), 1));
    first.push_back(static_cast<std::uint32_t>(sorted.indices.size()));
    for (std::size_t object = 0; object + 1 < index_first.size(); ++object) {
      for (std::size_t i = index_first[object]; i < index_first[object + 1]; i += 3) {
        if (static_cast<std::size_t>(paint_at(mesh, i)) != p) continue;
        sorted.indices.insert(sorted.indices.end(), {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
      }
      first.push_back(static_cast<std::uint32_t>(sorted.indices.size()));
    }
  }
  return sorted;
}

std::vector<std::uint8_t> count_lanes(const CityMesh& mesh) {
  std::vector<std::uint8_t> lanes(mesh.vertices.size(), 0);
  constexpr int kPasses = 3;  // a strip's vertices may hang together by a middle line only
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      std::uint8_t most = 0;
      for (std::size_t k = i; k < i + 3; ++k) {
        const CityVertex& vertex = mesh.vertices[mesh.indices[k]];
        if (material_of(vertex) != Material::asphalt) continue;
        const float v = std::clamp(std::round(vertex.uv.y), 0.0F, 255.0F);
        most = std::max({most, lanes[mesh.indices[k]], static_cast<std::uint8_t>(v)});
      }
      for (std::size_t k = i; most > 0 && k < i + 3; ++k) lanes[mesh.indices[k]] = most;
    }
  }
  return lanes;
}

}  // namespace manzana::draw
