#include "scenegraph/draw/city_layer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "gl/vertex_array.h"
#include "manzana_draw_shaders.h"

namespace manzana::draw {
namespace {

constexpr std::uint32_t kMaxBlocks = 1U << 24;

Material material_of(const CityVertex& vertex) { return static_cast<Material>(vertex.colour >> 24); }

// Flat values of a triangle are those of its last vertex.
Paint paint_at(const CityMesh& mesh, std::size_t triangle) {
  return paint_of(material_of(mesh.vertices[mesh.indices[triangle + 2]]));
}

std::vector<CityVertex> with_lanes(const CityMesh& mesh) {
  const std::vector<std::uint8_t> lanes = count_lanes(mesh);
  std::vector<CityVertex> vertices = mesh.vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].block >= kMaxBlocks) throw std::runtime_error("a scene of more than 2^24 blocks cannot be drawn");
    vertices[i].block |= std::uint32_t{lanes[i]} << 24;
  }
  return vertices;
}

/// From a row an object of the layer to a row an object of the tree, so that no run is looked up twice.
std::vector<std::uint32_t> of_objects(const std::vector<std::uint32_t>& first,
                                      std::span<const std::uint32_t> row_first) {
  std::vector<std::uint32_t> result;
  result.reserve(row_first.size());
  for (const std::uint32_t row : row_first) result.push_back(first[row]);
  return result;
}

gl::VertexArray make_array(const gl::Buffer& vertices, const gl::Buffer& indices) {
  gl::VertexArray array = gl::make_vertex_array(indices);
  const GLuint name = array.name();
  for (GLuint attribute = 0; attribute < 5; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, 0);
  }
  glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, offsetof(CityVertex, position));
  glVertexArrayAttribFormat(name, 1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, offsetof(CityVertex, normal));
  glVertexArrayAttribIFormat(name, 2, 1, GL_UNSIGNED_INT, offsetof(CityVertex, colour));
  glVertexArrayAttribFormat(name, 3, 2, GL_FLOAT, GL_FALSE, offsetof(CityVertex, uv));
  glVertexArrayAttribIFormat(name, 4, 1, GL_UNSIGNED_INT, offsetof(CityVertex, block));
  glVertexArrayVertexBuffer(name, 0, vertices.name(), 0, sizeof(CityVertex));
  return array;
}

gl::Program make_paint(std::string_view name, std::string_view fragment) {
  using namespace shaders;
  return gl::make_program(name, {version_glsl, frame_layout_glsl, frame_glsl, light_glsl, city_vert},
                          {version_glsl, frame_layout_glsl, frame_glsl, noise_glsl, light_glsl, city_glsl, fragment});
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

PaintPrograms make_paint_programs() {
  return {make_paint("facade", shaders::facade_frag), make_paint("roof", shaders::roof_frag),
          make_paint("road", shaders::road_frag), make_paint("water", shaders::water_frag),
          make_paint("ground", shaders::ground_frag)};
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

Drawn make_commands(std::span<const std::uint32_t> first, std::span<const culling::ObjectRun> runs,
                    gl::DrawCommand* out) {
  Drawn drawn;
  gl::DrawCommand open{0, 1, 0, 0, 0};
  const auto close = [&] {  // `out` is the GPU's memory: written in order, never read
    if (open.count == 0) return;
    out[drawn.commands++] = open;
    drawn.triangles += open.count / 3;
  };
  for (const culling::ObjectRun& run : runs) {
    const std::uint32_t begin = first[run.first], end = first[run.last];
    if (begin == open.first_index + open.count) {
      open.count += end - begin;
    } else if (begin < end) {
      close();
      open = {end - begin, 1, begin, 0, 0};
    }
  }
  close();
  return drawn;
}

PreparedLayer prepare_layer(const MeshLayer& layer) {
  PaintedIndices sorted = sort_by_paint(layer.mesh, layer.index_first);
  PreparedLayer prepared{with_lanes(layer.mesh), std::move(sorted.indices), {}};
  for (std::size_t p = 0; p < kPaints; ++p) prepared.first[p] = of_objects(sorted.first[p], layer.table.row_first);
  return prepared;
}

CityLayer::CityLayer(const PreparedLayer& prepared, gl::Uploads& uploads)
    : vertices(uploads.make(std::as_bytes(std::span(prepared.vertices)))),
      indices(uploads.make(std::as_bytes(std::span(prepared.indices)))),
      first(prepared.first) {
  array = make_array(vertices, indices);
}

void repaint(CityLayer& layer, const MeshLayer& from, std::span<const std::uint32_t> colours) {
  layer.painted.resize(colours.size(), kOwnColour);
  std::vector<CityVertex> changed;
  for (std::size_t row = 0; row < colours.size(); ++row) {
    if (std::exchange(layer.painted[row], colours[row]) == colours[row]) continue;
    const auto indices =
        std::span(from.mesh.indices).subspan(from.index_first[row], from.index_first[row + 1] - from.index_first[row]);
    if (indices.empty()) continue;
    const auto [low, high] = std::minmax_element(indices.begin(), indices.end());
    changed.assign(from.mesh.vertices.begin() + *low, from.mesh.vertices.begin() + *high + 1);
    if (colours[row] != kOwnColour)
      for (CityVertex& v : changed) v.colour = pack_colour(colours[row], material_of(v));
    glNamedBufferSubData(layer.vertices.name(), static_cast<GLintptr>(*low * sizeof(CityVertex)),
                         static_cast<GLsizeiptr>(changed.size() * sizeof(CityVertex)), changed.data());
  }
}

std::size_t stream_bytes(const CityLayer& layer, std::size_t runs) {
  return layer.first.size() * gl::StreamBuffer::padded(runs * sizeof(gl::DrawCommand));
}

Drawn draw_city(const CityLayer& layer, const PaintPrograms& paints, std::span<const culling::ObjectRun> objects,
                gl::StreamBuffer& stream) {
  Drawn drawn;
  glBindVertexArray(layer.array.name());
  for (std::size_t p = 0; p < kPaints; ++p) {
    if (layer.first[p].front() == layer.first[p].back()) continue;
    const auto commands = stream.take<gl::DrawCommand>(objects.size());
    const Drawn part = make_commands(layer.first[p], objects, commands.items);
    drawn.triangles += part.triangles;
    drawn.commands += part.commands;
    if (part.commands == 0) continue;
    glUseProgram(paints[p].name());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(commands.offset),
                                static_cast<GLsizei>(part.commands), 0);
  }
  return drawn;
}

}  // namespace manzana::draw
