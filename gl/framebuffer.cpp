#include "gl/framebuffer.h"

#include <algorithm>
#include <stdexcept>

namespace manzana::gl {
namespace {

Renderbuffer make_renderbuffer(GLenum format, const Target& target, int samples) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  Renderbuffer buffer(name);
  glNamedRenderbufferStorageMultisample(name, samples > 1 ? samples : 0, format, target.width, target.height);
  return buffer;
}

Framebuffer make_framebuffer(GLuint colour, GLuint depth) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  glNamedFramebufferRenderbuffer(name, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
  if (depth != 0) glNamedFramebufferRenderbuffer(name, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("the device cannot draw into sRGB colour with 32-bit float depth of that size");
  }
  return framebuffer;
}

}  // namespace

Target make_target(int width, int height, int samples) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  Target target;
  target.width = width;
  target.height = height;
  target.samples = std::clamp(samples, 1, std::max(1, most));
  target.colour = make_renderbuffer(GL_SRGB8_ALPHA8, target, target.samples);
  target.depth = make_renderbuffer(GL_DEPTH_COMPONENT32F, target, target.samples);
  target.framebuffer = make_framebuffer(target.colour.name(), target.depth.name());
  if (target.samples > 1) {
    target.resolved_colour = make_renderbuffer(GL_SRGB8_ALPHA8, target, 1);
    target.resolved = make_framebuffer(target.resolved_colour.name(), 0);
  }
  return target;
}

void bind(const Target& target) {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer.name());
  glViewport(0, 0, target.width, target.height);
}

void resolve(const Target& target) {
  if (target.samples == 1) return;
  glEnable(GL_FRAMEBUFFER_SRGB);
  glBlitNamedFramebuffer(target.framebuffer.name(), target.resolved.name(), 0, 0, target.width, target.height, 0, 0,
                         target.width, target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace manzana::gl
