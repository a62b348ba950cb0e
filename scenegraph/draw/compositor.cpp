#include "scenegraph/draw/compositor.h"

#include "gl/vertex_array.h"
#include "manzana_draw_shaders.h"

namespace manzana::draw {

Compositor::Compositor()
    : program(gl::make_program("overlay", {shaders::version_glsl, shaders::overlay_vert},
                               {shaders::version_glsl, shaders::overlay_frag})),
      nothing(gl::make_vertex_array()) {}

void draw_overlay(const Compositor& compositor, const gl::Target& target, const Overlay& how) {
  const PixelRect& v = how.viewport;
  glViewport(v.x, v.y, v.width, v.height);
  how.linear ? glEnable(GL_FRAMEBUFFER_SRGB) : glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(how.nearer_is_less ? GL_LEQUAL : GL_GEQUAL);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(compositor.program.name());
  glUniform2i(0, v.x, v.y);
  glUniform2f(1, static_cast<float>(how.depth_scale), static_cast<float>(how.depth_offset));
  glUniform1i(2, how.linear ? 0 : 1);
  glBindTextureUnit(0, target.colour.name());
  glBindTextureUnit(1, target.depth.name());
  glBindVertexArray(compositor.nothing.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

}  // namespace manzana::draw
