// EGL's headers come before glad's.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
//
#include <glad/gl.h>

#include <array>
#include <stdexcept>

#include "gl/context.h"

namespace manzana::gl {
namespace {

[[noreturn]] void fail(const char* step) {
  throw std::runtime_error(std::string("no OpenGL context without a window: ") + step + " failed");
}

EGLDisplay open_display() {
  // Mesa's surfaceless platform needs neither a display server nor a device; a vendor's EGL answers the default one.
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) return display;
  display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display == EGL_NO_DISPLAY) fail("eglGetDisplay");
  if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) fail("eglInitialize");
  return display;
}

EGLContext open_context(EGLDisplay display) {
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("eglBindAPI(OpenGL)");
  const std::array<EGLint, 11> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                          4,
                                          EGL_CONTEXT_MINOR_VERSION,
                                          5,
                                          EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                          EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
#ifndef NDEBUG
                                          EGL_CONTEXT_OPENGL_DEBUG,
                                          EGL_TRUE,
#endif
                                          EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) fail("eglCreateContext(OpenGL 4.5 core)");
  return context;
}

}  // namespace

HeadlessContext::HeadlessContext() : display_(open_display()) {
  context_ = open_context(display_);
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    eglDestroyContext(display_, context_);
    fail("eglMakeCurrent without a surface");
  }
  load_functions(eglGetProcAddress);
}

// The display stays initialised: EGL shares it within the process, so another context may still live on it.
HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void load_functions(GetProcAddress get) {
  const int version = gladLoadGL(get);
  if (version == 0) throw std::runtime_error("OpenGL: no functions found, is a context current?");
  if (version < GLAD_MAKE_VERSION(4, 5) || glClipControl == nullptr) {
    throw std::runtime_error("OpenGL 4.5 with glClipControl is needed, this is " +
                             std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                             std::to_string(GLAD_VERSION_MINOR(version)) + " on " + renderer_name());
  }
}

std::string renderer_name() {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "unknown" : reinterpret_cast<const char*>(name);
}

bool software_renderer() { return software_renderer(renderer_name()); }

bool software_renderer(std::string_view name) {
  for (const char* software : {"llvmpipe", "softpipe", "SwiftShader", "SWR"}) {
    if (name.find(software) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace manzana::gl
