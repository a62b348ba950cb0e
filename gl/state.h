#pragma once
/// Another's GL state: what of it our drawing touches is kept and put back, and nothing of it is relied on.
///   const SavedState saved;           // a context current
///   set_clean_state();
///   ...draw...                        // at the end of the scope all is as it was
#include <array>

#include "gl/handle.h"

namespace manzana::gl {

/// Switches off whatever a host may have left on that would change what is drawn: stencil, scissor, logic operations,
/// wire frames, clip planes, masks of samples, primitive restart.
void set_clean_state();

class SavedState {
 public:
  SavedState();
  ~SavedState();
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;
  GLuint framebuffer() const { return static_cast<GLuint>(draw_framebuffer_); }

 private:
  static constexpr std::size_t kSwitches = 22, kBuffers = 7, kUniforms = 2, kStorages = 19;
  struct Range {
    GLint buffer = 0;
    GLint64 start = 0, size = 0;
  };
  void save_ranges();
  void restore_ranges() const;
  void save_values();
  void restore_values() const;

  std::array<GLboolean, kSwitches> switches_{};
  std::array<GLint, kBuffers> buffers_{};
  std::array<Range, kUniforms> uniforms_;
  std::array<Range, kStorages> storages_;
  GLint program_ = 0, array_ = 0, draw_framebuffer_ = 0, read_framebuffer_ = 0, active_texture_ = 0;
  std::array<GLint, 2> textures_{}, array_textures_{}, samplers_{};  ///< of the first two units
  std::array<GLint, 4> viewport_{}, scissor_{};
  std::array<GLint, 6> blend_{};  ///< factors, equations
  std::array<GLboolean, 4> colour_mask_{};
  std::array<GLdouble, 2> depth_range_{};
  std::array<GLint, 2> clip_control_{}, polygon_mode_{};
  GLboolean depth_mask_ = 0;
  GLint depth_func_ = 0, cull_face_ = 0, front_face_ = 0, pack_alignment_ = 0, pack_row_length_ = 0;
  std::array<GLint, 8> unpack_{};
};

}  // namespace manzana::gl
