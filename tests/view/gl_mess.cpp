#include "tests/view/gl_mess.h"

namespace manzana {

std::vector<GLint64> state_of_gl() {
  std::vector<GLint64> state;
  for (const GLenum name : {GL_CURRENT_PROGRAM,
                            GL_VERTEX_ARRAY_BINDING,
                            GL_DRAW_FRAMEBUFFER_BINDING,
                            GL_READ_FRAMEBUFFER_BINDING,
                            GL_ACTIVE_TEXTURE,
                            GL_TEXTURE_BINDING_2D,
                            GL_TEXTURE_BINDING_2D_ARRAY,
                            GL_SAMPLER_BINDING,
                            GL_ARRAY_BUFFER_BINDING,
                            GL_DRAW_INDIRECT_BUFFER_BINDING,
                            GL_UNIFORM_BUFFER_BINDING,
                            GL_SHADER_STORAGE_BUFFER_BINDING,
                            GL_BLEND_SRC_RGB,
                            GL_BLEND_DST_ALPHA,
                            GL_BLEND_EQUATION_RGB,
                            GL_DEPTH_FUNC,
                            GL_CULL_FACE_MODE,
                            GL_FRONT_FACE,
                            GL_CLIP_ORIGIN,
                            GL_CLIP_DEPTH_MODE,
                            GL_PACK_ALIGNMENT,
                            GL_PACK_ROW_LENGTH,
                            GL_UNPACK_ALIGNMENT,
                            GL_UNPACK_ROW_LENGTH,
                            GL_UNPACK_SKIP_ROWS,
                            GL_PIXEL_UNPACK_BUFFER_BINDING,
                            GL_DEPTH_WRITEMASK}) {
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    state.push_back(value);
  }
  for (const GLenum name : {GL_VIEWPORT, GL_SCISSOR_BOX, GL_COLOR_WRITEMASK}) {
    GLint64 values[4] = {0, 0, 0, 0};
    glGetInteger64v(name, values);
    state.insert(state.end(), values, values + 4);
  }
  for (const GLenum name : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_STENCIL_TEST,
                            GL_FRAMEBUFFER_SRGB, GL_COLOR_LOGIC_OP, GL_PROGRAM_POINT_SIZE, GL_RASTERIZER_DISCARD,
                            GL_MULTISAMPLE, GL_POLYGON_OFFSET_FILL, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_DEPTH_CLAMP})
    state.push_back(glIsEnabled(name));
  for (GLuint i = 0; i < 4; ++i) {
    GLint binding = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, i, &binding);
    state.push_back(binding);
  }
  return state;
}

void leave_a_mess(const gl::Buffer& buffer) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(3, 3, 5, 5);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_NEVER, 1, 255);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_ZERO);
  glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_NEVER);
  glDepthRange(0.25, 0.5);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT_AND_BACK);
  glFrontFace(GL_CW);
  glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_CLEAR);
  glEnable(GL_PRIMITIVE_RESTART);
  glPrimitiveRestartIndex(0);
  glEnable(GL_SAMPLE_MASK);
  glSampleMaski(0, 0);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPixelStorei(GL_PACK_ALIGNMENT, 8);
  glPixelStorei(GL_PACK_ROW_LENGTH, 77);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 33);
  glPixelStorei(GL_UNPACK_SKIP_ROWS, 2);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer.name());
  glActiveTexture(GL_TEXTURE1);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffer.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
}

}  // namespace manzana
