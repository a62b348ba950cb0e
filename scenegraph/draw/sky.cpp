#include "scenegraph/draw/sky.h"

#include "gl/vertex_array.h"
#include "manzana_draw_shaders.h"
#include "scenegraph/draw/photo_layer.h"

namespace manzana::draw {
namespace {

constexpr GLsizei kVertices = 3 * 48;  // sky.vert

gl::Program make_half(std::string_view name, std::string_view fragment, const PhotoPieces& photo, float side) {
  using namespace shaders;
  gl::Program program = gl::make_program(
      name, {version_glsl, frame_layout_glsl, frame_glsl, sky_vert},
      {version_glsl, frame_layout_glsl, frame_glsl, noise_glsl, light_glsl, photo[0], photo[1], fragment});
  glProgramUniform1f(program.name(), 0, side);
  return program;
}

}  // namespace

Sky::Sky(bool photo)
    : above(make_half("sky", shaders::sky_frag, photo_pieces(false), 1)),
      below(make_half("earth", shaders::earth_frag, photo_pieces(photo), -1)) {
  nothing = gl::make_vertex_array();
}

void draw_sky(const Sky& sky) {
  glBindVertexArray(sky.nothing.name());
  glDepthMask(GL_FALSE);
  for (const gl::Program* program : {&sky.above, &sky.below}) {
    glUseProgram(program->name());
    glDrawArrays(GL_TRIANGLES, 0, kVertices);
  }
  glDepthMask(GL_TRUE);
}

}  // namespace manzana::draw
