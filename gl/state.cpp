#include "gl/state.h"

namespace manzana::gl {
namespace {

constexpr std::array<GLenum, 22> kSwitchNames{GL_BLEND,
                                              GL_COLOR_LOGIC_OP,
                                              GL_CULL_FACE,
                                              GL_DEPTH_CLAMP,
                                              GL_DEPTH_TEST,
                                              GL_DITHER,
                                              GL_FRAMEBUFFER_SRGB,
                                              GL_LINE_SMOOTH,
                                              GL_MULTISAMPLE,
                                              GL_POLYGON_OFFSET_FILL,
                                              GL_POLYGON_SMOOTH,
                                              GL_PRIMITIVE_RESTART,
                                              GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                              GL_RASTERIZER_DISCARD,
                                              GL_SAMPLE_ALPHA_TO_COVERAGE,
                                              GL_SAMPLE_ALPHA_TO_ONE,
                                              GL_SAMPLE_COVERAGE,
                                              GL_SAMPLE_SHADING,
                                              GL_SAMPLE_MASK,
                                              GL_SCISSOR_TEST,
                                              GL_STENCIL_TEST,
                                              GL_PROGRAM_POINT_SIZE};

struct BufferTarget {
  GLenum target, query;
};
constexpr std::array<BufferTarget, 7> kBufferTargets{
    {{GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
     {GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING},
     {GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING},
     {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
     {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
     {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING},
     {GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING}}};

constexpr std::array<GLenum, 6> kBlend{GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                                       GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};

struct Unpack {
  GLenum name;
  GLint plain;
};
constexpr std::array<Unpack, 8> kUnpack{{{GL_UNPACK_ALIGNMENT, 4},
                                         {GL_UNPACK_ROW_LENGTH, 0},
                                         {GL_UNPACK_IMAGE_HEIGHT, 0},
                                         {GL_UNPACK_SKIP_PIXELS, 0},
                                         {GL_UNPACK_SKIP_ROWS, 0},
                                         {GL_UNPACK_SKIP_IMAGES, 0},
                                         {GL_UNPACK_SWAP_BYTES, 0},
                                         {GL_UNPACK_LSB_FIRST, 0}}};

void set(GLenum name, GLboolean on) { on == GL_TRUE ? glEnable(name) : glDisable(name); }

}  // namespace

void set_clean_state() {
  for (const GLenum name : kSwitchNames)
    if (name != GL_MULTISAMPLE && name != GL_DITHER) glDisable(name);
  glEnable(GL_MULTISAMPLE);
  GLint planes = 0;
  glGetIntegerv(GL_MAX_CLIP_DISTANCES, &planes);
  for (GLint i = 0; i < planes; ++i) glDisable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthRange(0, 1);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlendEquation(GL_FUNC_ADD);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  for (const Unpack& u : kUnpack) glPixelStorei(u.name, u.plain);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (GLuint unit = 0; unit < 2; ++unit) glBindSampler(unit, 0);
}

SavedState::SavedState() {
  for (std::size_t i = 0; i < kSwitches; ++i) switches_[i] = glIsEnabled(kSwitchNames[i]);
  for (std::size_t i = 0; i < kBuffers; ++i) glGetIntegerv(kBufferTargets[i].query, &buffers_[i]);
  save_ranges();
  save_values();
}

SavedState::~SavedState() {
  restore_ranges();
  for (std::size_t i = 0; i < kBuffers; ++i) glBindBuffer(kBufferTargets[i].target, static_cast<GLuint>(buffers_[i]));
  restore_values();
  for (std::size_t i = 0; i < kSwitches; ++i) set(kSwitchNames[i], switches_[i]);
}

void SavedState::save_ranges() {
  const auto save = [](Range& range, GLuint i, GLenum binding, GLenum start, GLenum size) {
    glGetIntegeri_v(binding, i, &range.buffer);
    glGetInteger64i_v(start, i, &range.start);
    glGetInteger64i_v(size, i, &range.size);
  };
  for (GLuint i = 0; i < kUniforms; ++i)
    save(uniforms_[i], i, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE);
  for (GLuint i = 0; i < kStorages; ++i)
    save(storages_[i], i, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
         GL_SHADER_STORAGE_BUFFER_SIZE);
}

void SavedState::restore_ranges() const {
  const auto restore = [](const Range& range, GLuint i, GLenum target) {
    if (range.size > 0)
      glBindBufferRange(target, i, static_cast<GLuint>(range.buffer), range.start, range.size);
    else
      glBindBufferBase(target, i, static_cast<GLuint>(range.buffer));
  };
  for (GLuint i = 0; i < kUniforms; ++i) restore(uniforms_[i], i, GL_UNIFORM_BUFFER);
  for (GLuint i = 0; i < kStorages; ++i) restore(storages_[i], i, GL_SHADER_STORAGE_BUFFER);
}

void SavedState::save_values() {
  glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &array_);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active_texture_);
  for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &textures_[unit]);
    glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &array_textures_[unit]);
    glGetIntegerv(GL_SAMPLER_BINDING, &samplers_[unit]);
  }
  glActiveTexture(static_cast<GLenum>(active_texture_));
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  glGetIntegerv(GL_SCISSOR_BOX, scissor_.data());
  for (std::size_t i = 0; i < kBlend.size(); ++i) glGetIntegerv(kBlend[i], &blend_[i]);
  glGetBooleanv(GL_COLOR_WRITEMASK, colour_mask_.data());
  glGetDoublev(GL_DEPTH_RANGE, depth_range_.data());
  glGetIntegerv(GL_CLIP_ORIGIN, &clip_control_[0]);
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &clip_control_[1]);
  glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
  glGetIntegerv(GL_DEPTH_FUNC, &depth_func_);
  glGetIntegerv(GL_CULL_FACE_MODE, &cull_face_);
  glGetIntegerv(GL_FRONT_FACE, &front_face_);
  glGetIntegerv(GL_PACK_ALIGNMENT, &pack_alignment_);
  glGetIntegerv(GL_PACK_ROW_LENGTH, &pack_row_length_);
  for (std::size_t i = 0; i < kUnpack.size(); ++i) glGetIntegerv(kUnpack[i].name, &unpack_[i]);
}

void SavedState::restore_values() const {
  const auto e = [](GLint value) { return static_cast<GLenum>(value); };
  glUseProgram(e(program_));
  glBindVertexArray(e(array_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, e(draw_framebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, e(read_framebuffer_));
  for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, e(textures_[unit]));
    glBindTexture(GL_TEXTURE_2D_ARRAY, e(array_textures_[unit]));
    glBindSampler(static_cast<GLuint>(unit), e(samplers_[unit]));
  }
  glActiveTexture(e(active_texture_));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glScissor(scissor_[0], scissor_[1], scissor_[2], scissor_[3]);
  glBlendFuncSeparate(e(blend_[0]), e(blend_[1]), e(blend_[2]), e(blend_[3]));
  glBlendEquationSeparate(e(blend_[4]), e(blend_[5]));
  glColorMask(colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
  glDepthRange(depth_range_[0], depth_range_[1]);
  glClipControl(e(clip_control_[0]), e(clip_control_[1]));
  glPolygonMode(GL_FRONT_AND_BACK, e(polygon_mode_[0]));
  glDepthMask(depth_mask_);
  glDepthFunc(e(depth_func_));
  glCullFace(e(cull_face_));
  glFrontFace(e(front_face_));
  glPixelStorei(GL_PACK_ALIGNMENT, pack_alignment_);
  glPixelStorei(GL_PACK_ROW_LENGTH, pack_row_length_);
  for (std::size_t i = 0; i < kUnpack.size(); ++i) glPixelStorei(kUnpack[i].name, unpack_[i]);
}

}  // namespace manzana::gl
