#pragma once
/// A GL 4.5 core context without a window, through EGL (surfaceless). Made current on construction.
#include <string>
#include <string_view>

namespace manzana::gl {

class HeadlessContext {
 public:
  /// Throws std::runtime_error that says which step failed.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

/// Loads the functions of the current context by its loader (glfwGetProcAddress, eglGetProcAddress), and asks for
/// version 4.5 and clip control. Throws std::runtime_error naming what is missing.
using GetProcAddress = void (*(*)(const char*))();
void load_functions(GetProcAddress get);

std::string renderer_name();                    ///< GL_RENDERER
bool software_renderer();                       ///< by that name
bool software_renderer(std::string_view name);  ///< llvmpipe, softpipe, SwiftShader

}  // namespace manzana::gl
