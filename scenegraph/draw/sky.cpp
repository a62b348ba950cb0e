#include "scenegraph/draw/sky.h"

#include "manzana_draw_shaders.h"

namespace manzana::draw {

Sky::Sky()
    : program(gl::make_program(
          "sky", {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl, shaders::sky_vert},
          {shaders::version_glsl, shaders::frame_layout_glsl, shaders::frame_glsl, shaders::noise_glsl,
           shaders::light_glsl, shaders::sky_frag})) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  nothing = gl::VertexArray(name);
}

void draw_sky(const Sky& sky) {
  glUseProgram(sky.program.name());
  glBindVertexArray(sky.nothing.name());
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
}

}  // namespace manzana::draw
