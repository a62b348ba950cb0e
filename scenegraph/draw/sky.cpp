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
      {version_glsl, frame_layout_glsl, frame_glsl, noise_glsl, light_glsl, photo[0], photo[1], earth_glsl, fragment});
  glProgramUniform1f(program.name(), 0, side);
  return program;
}

void draw(const gl::Program& half) {
  glUseProgram(half.name());
  glDrawArrays(GL_TRIANGLES, 0, kVertices);
}

}  // namespace

Sky::Sky(bool with_photo)
    : above(make_half("sky", shaders::sky_frag, photo_pieces(false), 1)),
      below(make_half("earth", shaders::earth_frag, photo_pieces(with_photo), -1)) {
  nothing = gl::make_vertex_array();
  if (with_photo) photo = make_half("photo", shaders::photo_earth_frag, photo_pieces(true), -1);
}

void draw_sky(const Sky& sky) {
  glBindVertexArray(sky.nothing.name());
  glDepthMask(GL_FALSE);
  draw(sky.above);
  draw(sky.below);
  glDepthMask(GL_TRUE);
}

void draw_bare_photo(const Sky& sky) {
  if (!sky.photo) return;
  glBindVertexArray(sky.nothing.name());
  glDepthMask(GL_FALSE);
  draw(*sky.photo);
  glDepthMask(GL_TRUE);
}

}  // namespace manzana::draw
