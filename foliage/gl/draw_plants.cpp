#include "foliage/gl/draw_plants.h"

#include "gl/vertex_array.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

gl::Program make_program(std::string_view name, const HostShaders& host, const gl::Pieces& main,
                         const gl::Pieces& fragment) {
  using namespace shaders;
  gl::Pieces vertex{version_glsl, select_layout_glsl, extract_glsl, hash_glsl};
  vertex.insert(vertex.end(), host.vertex.begin(), host.vertex.end());
  vertex.insert(vertex.end(), {packed_normal_glsl, flat_picture_glsl, sway_glsl, plant_glsl});
  vertex.insert(vertex.end(), main.begin(), main.end());
  gl::Pieces pixels{version_glsl, hash_glsl, tree_share_glsl, cover_glsl, plant_share_glsl};
  pixels.insert(pixels.end(), fragment.begin(), fragment.end());
  return gl::make_program(name, vertex, pixels);
}

void draw_quads(GLintptr commands, std::uint32_t draws) {
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(commands),
                              static_cast<GLsizei>(draws), 5 * sizeof(GLuint));
}

void use(const gl::Program& program, const gl::Buffer& primitives, const DrawPlantsOptions& options) {
  glUseProgram(program.name());
  glUniform1f(0, options.focal_px);
  set_wind(options.wind);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kPrimitivesBinding, primitives.name());
}

}  // namespace

void set_wind(const Wind& wind) { glUniform4f(2, wind.towards.x, wind.towards.y, wind.towards.z, wind.seconds); }

gl::Buffer make_quad_indices(std::uint32_t quads) {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t{6} * quads);
  for (std::uint32_t first = 0; first < 4 * quads; first += 4)
    indices.insert(indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  return gl::make_buffer(std::as_bytes(std::span(indices)));
}

PlantPrograms::PlantPrograms(const HostShaders& host)
    : quads(make_program("plant_quads", host, {shaders::plant_quad_glsl, shaders::plant_quads_vert}, host.quads)),
      lines(make_program("plant_lines", host, {shaders::plant_lines_vert}, host.lines)),
      points(make_program("plant_points", host, {shaders::plant_points_vert}, host.points)),
      indices(make_quad_indices(glsl::kQuadsOfDraw)) {
  array = gl::make_vertex_array(indices);
}

void draw_plants(const PlantPrograms& programs, const PlantStore& store, const Extractor& extractor,
                 const DrawPlantsOptions& options) {
  const CommandPlaces at = command_places(extractor.capacity);
  glBindVertexArray(programs.array.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, extractor.commands.name());
  glBindTextureUnit(0, store.images.name());
  use(programs.quads, store.quads, options);
  glUniform1ui(1, static_cast<GLuint>(options.samples));
  draw_quads(at.quads, extractor.capacity.quad_draws);
  use(programs.lines, store.lines, options);
  glUniform1ui(1, static_cast<GLuint>(options.samples));
  draw_quads(at.lines, extractor.capacity.line_draws);
  glEnable(GL_PROGRAM_POINT_SIZE);
  use(programs.points, store.points, options);
  glUniform1ui(1, static_cast<GLuint>(options.samples));
  glDrawArraysIndirect(GL_POINTS, reinterpret_cast<const void*>(at.points));
  glDisable(GL_PROGRAM_POINT_SIZE);
}

}  // namespace manzana::foliage
