#pragma once
/// GL names as move-only values. Each dies with its context current; 0 owns nothing.
///   Buffer vertices = make_buffer(bytes, 0);      // gl/buffer.h
/// Where the context is gone already, nothing may be asked of GL:
///   const LostContext lost; renderer.reset();     // the names are given up
#include <glad/gl.h>

#include <utility>

namespace manzana::gl {

/// While one lives, names and mapped memory that die on this thread are given up without a call.
class LostContext {
 public:
  LostContext() { ++alive(); }
  ~LostContext() { --alive(); }
  LostContext(const LostContext&) = delete;
  LostContext& operator=(const LostContext&) = delete;
  static bool any() { return alive() > 0; }

 private:
  static int& alive() {
    thread_local int count = 0;
    return count;
  }
};

template <void (*Delete)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_ != 0 && !LostContext::any()) Delete(name_);
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }
inline void delete_shader(GLuint name) { glDeleteShader(name); }
inline void delete_query(GLuint name) { glDeleteQueries(1, &name); }

using Buffer = Handle<delete_buffer>;
using VertexArray = Handle<delete_vertex_array>;
using Texture = Handle<delete_texture>;
using Framebuffer = Handle<delete_framebuffer>;
using Renderbuffer = Handle<delete_renderbuffer>;
using Program = Handle<delete_program>;
using Shader = Handle<delete_shader>;
using Query = Handle<delete_query>;

}  // namespace manzana::gl
