// A host of fifty lines: a context of its own, a framebuffer of its own, a city in it.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <glad/gl.h>

#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "manzana/view.h"

namespace {

constexpr int kWidth = 320, kHeight = 200;

bool make_context() {
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE || eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return false;
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
  return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE &&
         gladLoadGL(eglGetProcAddress) != 0;
}

void make_framebuffer() {
  GLuint buffers[2], framebuffer;
  glCreateRenderbuffers(2, buffers);
  glNamedRenderbufferStorage(buffers[0], GL_RGBA8, kWidth, kHeight);
  glNamedRenderbufferStorage(buffers[1], GL_DEPTH_COMPONENT24, kWidth, kHeight);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

}  // namespace

int main() {
  if (!make_context()) return 1;
  make_framebuffer();
  manzana::View view;
  view.show(manzana::Model::load("builtin:town", {.cars = 0, .trees = false}));
  manzana::HostCamera camera;
  camera.projection = glm::perspective(1.0, 1.6, 0.5, 5000.0);
  camera.view = glm::lookAt(glm::dvec3(0, -300, 60), glm::dvec3(0, 0, 10), glm::dvec3(0, 0, 1));
  camera.viewport = {0, 0, kWidth, kHeight};
  for (int frame = 0; frame < 100; ++frame) {
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    view.update({&camera, 1}, frame / 30.0);
    view.render(0);
  }
  unsigned char pixel[4];
  glReadPixels(kWidth / 2, kHeight / 4, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
  std::printf("%llu buildings in view, alpha %d\n",
              static_cast<unsigned long long>(view.update({&camera, 1}, 0).cameras[0].buildings), pixel[3]);
  view.release();
}
