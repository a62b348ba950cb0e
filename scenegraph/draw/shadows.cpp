#include "scenegraph/draw/shadows.h"

#include "manzana_draw_shaders.h"

namespace manzana::draw {

gl::Program make_shadow(std::string_view name, std::string_view vertex) {
  using namespace shaders;
  return gl::make_program(name, {version_glsl, select_layout_glsl, frame_layout_glsl, frame_glsl, vertex},
                          {version_glsl, shadow_frag});
}

Drawn draw_shadows(const gl::Program& program, std::uint32_t instances) {
  if (instances == 0) return {};
  glUseProgram(program.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  glDepthMask(GL_FALSE);
  glDrawArraysInstanced(GL_TRIANGLE_FAN, 0, 4, static_cast<GLsizei>(instances));
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  return {2 * std::uint64_t{instances}, 1};
}

}  // namespace manzana::draw
