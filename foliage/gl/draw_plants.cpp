#include "foliage/gl/draw_plants.h"

#include "gl/vertex_array.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

gl::Program make_program(std::string_view name, const HostShaders& host, int samples, const gl::Pieces& main,
                         const gl::Pieces& fragment) {
  using namespace shaders;
  const std::string define = define_samples(samples);
  gl::Pieces vertex{version_glsl, define, select_layout_glsl, extract_glsl, hash_glsl, samples_glsl};
  vertex.insert(vertex.end(), host.vertex.begin(), host.vertex.end());
  vertex.insert(vertex.end(), {packed_normal_glsl, flat_picture_glsl, sway_glsl, plant_glsl});
  vertex.insert(vertex.end(), main.begin(), main.end());
  gl::Pieces pixels{version_glsl, define, hash_glsl, samples_glsl, tree_share_glsl, cover_glsl, plant_share_glsl};
  pixels.insert(pixels.end(), fragment.begin(), fragment.end());
  return gl::make_program(name, vertex, pixels);
}

PlantPrograms::Programs make_programs(const HostShaders& host, int samples) {
  using namespace shaders;
  return {.quads = make_program("plant_quads", host, samples, {plant_quad_glsl, plant_quads_vert}, host.quads),
          .lines = make_program("plant_lines", host, samples, {plant_lines_vert}, host.lines),
          .points = make_program("plant_points", host, samples, {plant_points_vert}, host.points)};
}

const PlantPrograms::Programs& programs_for(PlantPrograms& programs, int samples) {
  const auto at = programs.by_samples.find(samples);
  return at != programs.by_samples.end()
             ? at->second
             : programs.by_samples.emplace(samples, make_programs(programs.host, samples)).first->second;
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

std::string define_samples(int samples) { return "#define SAMPLES " + std::to_string(samples) + "u\n"; }

PlantPrograms::PlantPrograms(HostShaders shaders)
    : host(std::move(shaders)), indices(make_quad_indices(glsl::kQuadsOfDraw)) {
  array = gl::make_vertex_array(indices);
}

void draw_plants(PlantPrograms& programs, const PlantStore& store, const Extractor& extractor,
                 const DrawPlantsOptions& options) {
  const auto& [quads, lines, points] = programs_for(programs, options.samples);
  const CommandPlaces at = command_places(extractor.capacity);
  glBindVertexArray(programs.array.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, extractor.commands.name());
  glBindTextureUnit(0, store.images.name());
  use(quads, store.quads, options);
  draw_quads(at.quads, extractor.capacity.quad_draws);
  use(lines, store.lines, options);
  draw_quads(at.lines, extractor.capacity.line_draws);
  glEnable(GL_PROGRAM_POINT_SIZE);
  use(points, store.points, options);
  glDrawArraysIndirect(GL_POINTS, reinterpret_cast<const void*>(at.points));
  glDisable(GL_PROGRAM_POINT_SIZE);
}

}  // namespace manzana::foliage
