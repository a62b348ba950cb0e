#include "foliage/gl/ldm_sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "foliage/ldm_texture.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

gl::Texture make_texture(GLenum format, int side) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  gl::Texture texture(name);
  glTextureStorage2D(name, 1, format, side, side);
  return texture;
}

gl::Framebuffer make_framebuffer(const gl::Texture& colour, const gl::Texture& surface, const gl::Texture& depth) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  gl::Framebuffer framebuffer(name);
  constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferTexture(name, kBoth[0], colour.name(), 0);
  glNamedFramebufferTexture(name, kBoth[1], surface.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth.name(), 0);
  glNamedFramebufferDrawBuffers(name, 2, kBoth.data());
  if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the device cannot draw a plant's slabs");
  return framebuffer;
}

gl::Program make_program() {
  using namespace shaders;
  return gl::make_program("ldm_sample", {version_glsl, hash_glsl, packed_normal_glsl, plant_quad_glsl, ldm_sample_vert},
                          {version_glsl, cover_glsl, ldm_sample_frag});
}

LdmTexel texel_of(const std::uint8_t* colour, const std::uint8_t* surface) {
  return {{colour[0], colour[1], colour[2], colour[3]}, surface[0], surface[1], surface[2], surface[3]};
}

}  // namespace

LdmSamplerGl::LdmSamplerGl(const PreparedPlant& plant, int fine)
    : fine_(fine),
      side_(fine * kLdmPixels),
      bark_(finest_bark(plant)),
      leaves_{static_cast<std::uint32_t>(plant.bark.size()),
              static_cast<std::uint32_t>(plant.bark.size() + plant.leaves.size())},
      first_leaf_(leaves_.first),
      store_({&plant, 1}),
      colour_(make_texture(GL_RGBA8, side_)),
      surface_(make_texture(GL_RGBA8, side_)),
      depth_(make_texture(GL_DEPTH_COMPONENT32F, side_)),
      framebuffer_(make_framebuffer(colour_, surface_, depth_)),
      program_(make_program()),
      array_(gl::make_vertex_array()),
      colours_(std::size_t{4} * static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)),
      surfaces_(colours_.size()) {
  assert(fine == 1 || fine == 2 || fine == 4 || fine == 8);
}

void LdmSamplerGl::set_view(const ParallelView& view) {
  const GLuint program = program_.name();
  glProgramUniform3fv(program, 0, 1, &view.centre().x);
  glProgramUniform1ui(program, 1, 1);  // sample
  glProgramUniform3fv(program, 2, 1, &view.right().x);
  glProgramUniform3fv(program, 3, 1, &view.up().x);
  glProgramUniform3fv(program, 4, 1, &view.towards().x);
  glProgramUniform1f(program, 5, view.radius());
  glProgramUniform1ui(program, 7, first_leaf_);
  glUseProgram(program);
  glBindVertexArray(array_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kPrimitivesBinding, store_.quads.name());
  glBindTextureUnit(0, store_.images.name());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, side_, side_);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_FRAMEBUFFER_SRGB}) glDisable(off);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
}

/// What is not in the slab is cut off by the view's near and far planes.
void LdmSamplerGl::draw_slab(const ParallelView& view, int layer, int layers) {
  const float thickness = 2 * view.radius() / static_cast<float>(layers), farthest = 1;
  const Vec4 nothing{0};
  glUniform2f(6, view.radius() - static_cast<float>(layer) * thickness, thickness);
  for (const GLint part : {0, 1}) glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, part, &nothing.x);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
  for (const Run& run : {bark_, leaves_})
    glDrawArrays(GL_TRIANGLES, static_cast<GLint>(6 * run.first), static_cast<GLsizei>(6 * run.size()));
}

void LdmSamplerGl::read_slab(int layer, LdmImage& image) {
  for (const auto& [part, bytes] : {std::pair{GL_COLOR_ATTACHMENT0, &colours_}, {GL_COLOR_ATTACHMENT1, &surfaces_}}) {
    glNamedFramebufferReadBuffer(framebuffer_.name(), static_cast<GLenum>(part));
    glReadPixels(0, 0, side_, side_, GL_RGBA, GL_UNSIGNED_BYTE, bytes->data());
  }
  tbb::parallel_for(0, kLdmPixels, [&](int y) {
    for (int x = 0; x < kLdmPixels; ++x) {
      LdmSquare square{fine_, {}};
      for (int j = 0; j < fine_; ++j)
        for (int i = 0; i < fine_; ++i) {
          const auto at = 4 * (static_cast<std::size_t>(y * fine_ + j) * static_cast<std::size_t>(side_) +
                               static_cast<std::size_t>(x * fine_ + i));
          square.texels.push_back(texel_of(&colours_[at], &surfaces_[at]));
        }
      const auto covered = [](const LdmTexel& t) { return t.colour[3] > 0; };
      if (std::none_of(square.texels.begin(), square.texels.end(), covered)) continue;
      while (square.side > 1) square = halved(square);
      image.at(layer, x, y) = square.texels[0];
    }
  });
}

LdmImage LdmSamplerGl::operator()(const ParallelView& view, int layers) {
  LdmImage image(layers);
  set_view(view);
  for (int layer = 0; layer < layers; ++layer) {
    draw_slab(view, layer, layers);
    read_slab(layer, image);
  }
  return image;
}

}  // namespace manzana::foliage
