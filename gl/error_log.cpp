#include "gl/error_log.h"

#include <glad/gl.h>

namespace manzana::gl {
namespace {

// Called by the driver, from C: nothing may be thrown through it.
void on_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void* user) {
  const bool serious = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
  if (!serious && severity != GL_DEBUG_SEVERITY_HIGH) return;
  auto* messages = static_cast<std::vector<std::string>*>(const_cast<void*>(user));
  messages->emplace_back(text);
}

}  // namespace

ErrorLog::ErrorLog() : messages_(std::make_unique<std::vector<std::string>>()) {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_message, messages_.get());
}

ErrorLog::~ErrorLog() {
  glDebugMessageCallback(nullptr, nullptr);
  glDisable(GL_DEBUG_OUTPUT);
}

const std::vector<std::string>& ErrorLog::messages() {
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
    messages_->push_back("GL error " + std::to_string(error));
  }
  return *messages_;
}

}  // namespace manzana::gl
