#include "gl/framebuffer.h"

#include <algorithm>
#include <stdexcept>

namespace manzana::gl {
namespace {

constexpr GLenum kColour = GL_SRGB8_ALPHA8, kDepth = GL_DEPTH_COMPONENT32F;

Renderbuffer make_renderbuffer(GLenum format, const Target& target) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  Renderbuffer buffer(name);
  glNamedRenderbufferStorageMultisample(name, target.samples, format, target.width, target.height);
  return buffer;
}

Texture make_texture(GLenum format, const Target& target) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  Texture texture(name);
  glTextureStorage2D(name, 1, format, target.width, target.height);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

void check(const Framebuffer& framebuffer) {
  if (glCheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the device cannot draw into sRGB colour with 32-bit float depth of that size");
}

Framebuffer with_textures(const Target& target) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, target.colour.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, target.depth.name(), 0);
  check(framebuffer);
  return framebuffer;
}

Framebuffer with_samples(const Target& target) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  glNamedFramebufferRenderbuffer(name, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target.sampled_colour.name());
  glNamedFramebufferRenderbuffer(name, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.sampled_depth.name());
  check(framebuffer);
  return framebuffer;
}

void blit(const Target& target, GLbitfield what) {
  glBlitNamedFramebuffer(target.framebuffer.name(), target.resolved.name(), 0, 0, target.width, target.height, 0, 0,
                         target.width, target.height, what, GL_NEAREST);
}

}  // namespace

Target make_target(int width, int height, int samples) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  Target target;
  target.width = width;
  target.height = height;
  target.samples = std::clamp(samples, 1, std::max(1, most));
  target.colour = make_texture(kColour, target);
  target.depth = make_texture(kDepth, target);
  (target.samples > 1 ? target.resolved : target.framebuffer) = with_textures(target);
  if (target.samples == 1) return target;
  target.sampled_colour = make_renderbuffer(kColour, target);
  target.sampled_depth = make_renderbuffer(kDepth, target);
  target.framebuffer = with_samples(target);
  return target;
}

void bind(const Target& target) {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer.name());
  glViewport(0, 0, target.width, target.height);
}

void resolve(const Target& target) {
  if (target.samples == 1) return;
  glEnable(GL_FRAMEBUFFER_SRGB);
  blit(target, GL_COLOR_BUFFER_BIT);
}

void resolve_depth(const Target& target) {
  if (target.samples > 1) blit(target, GL_DEPTH_BUFFER_BIT);
}

}  // namespace manzana::gl
