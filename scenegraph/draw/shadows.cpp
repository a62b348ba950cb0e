#include "scenegraph/draw/shadows.h"

#include "manzana_draw_shaders.h"

namespace manzana::draw {
namespace {

gl::Program make_shadow(std::string_view name, std::string_view vertex) {
  using namespace shaders;
  return gl::make_program(name, {version_glsl, frame_layout_glsl, frame_glsl, vertex}, {version_glsl, shadow_frag});
}

}  // namespace

Shadows::Shadows()
    : tree(make_shadow("shadow_tree", shaders::shadow_tree_vert)),
      car(make_shadow("shadow_car", shaders::shadow_car_vert)) {}

Drawn draw_shadows(const gl::Program& program, const MeshSet& set, const InstanceBins& bins) {
  const std::uint32_t total = bins.total();
  if (total == 0) return {};
  glUseProgram(program.name());
  glBindVertexArray(set.array.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  glDepthMask(GL_FALSE);
  glDrawArraysInstanced(GL_TRIANGLE_FAN, 0, 4, static_cast<GLsizei>(total));
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  return {2 * std::uint64_t{total}, 1};
}

}  // namespace manzana::draw
