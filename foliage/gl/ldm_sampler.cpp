#include "foliage/gl/ldm_sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "foliage/ldm_texture.h"
#include "gl/buffer.h"
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
      plant_(plant),
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
  glProgramUniform1ui(program, 7, static_cast<GLuint>(plant_.bark.size()));
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

/// Slab after slab the quads that reach into it: most are in one or two.
std::vector<Run> LdmSamplerGl::sort_quads(const ParallelView& view, int layers) {
  std::vector<std::vector<std::uint32_t>> slabs(static_cast<std::size_t>(layers));
  const float per_slab = static_cast<float>(layers) / (2 * view.radius());
  const auto add = [&](const PlantQuad& quad, std::uint32_t index) {
    float nearest = -view.radius(), farthest = view.radius();
    for (const PlantQuad::Corner& c : quad.corners) {
      const float at = view.nearness(c.position);
      nearest = std::max(nearest, at), farthest = std::min(farthest, at);
    }
    const auto slab = [&](float nearness) {
      return std::clamp(static_cast<int>((view.radius() - nearness) * per_slab), 0, layers - 1);
    };
    for (int i = slab(nearest); i <= slab(farthest); ++i) slabs[static_cast<std::size_t>(i)].push_back(index);
  };
  const Run bark = finest_bark(plant_);
  for (std::uint32_t i = bark.first; i < bark.last; ++i) add(plant_.bark[i], i);
  for (std::uint32_t i = 0; i < plant_.leaves.size(); ++i)
    add(plant_.leaves[i], static_cast<std::uint32_t>(plant_.bark.size()) + i);
  std::vector<std::uint32_t> all;
  std::vector<Run> runs;
  for (const auto& slab : slabs) {
    runs.push_back({static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(all.size() + slab.size())});
    all.insert(all.end(), slab.begin(), slab.end());
  }
  slab_quads_ = gl::make_buffer(std::as_bytes(std::span(all)));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, slab_quads_.name());
  return runs;
}

/// What is not in the slab is cut off by the view's near and far planes.
void LdmSamplerGl::draw_slab(const ParallelView& view, int layer, int layers, const Run& quads) {
  const float thickness = 2 * view.radius() / static_cast<float>(layers), farthest = 1;
  const Vec4 nothing{0};
  glUniform2f(6, view.radius() - static_cast<float>(layer) * thickness, thickness);
  for (const GLint part : {0, 1}) glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, part, &nothing.x);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
  glDrawArrays(GL_TRIANGLES, static_cast<GLint>(6 * quads.first), static_cast<GLsizei>(6 * quads.size()));
}

void LdmSamplerGl::read_slab(int layer, LdmImage& image) {
  for (const auto& [part, bytes] : {std::pair{GL_COLOR_ATTACHMENT0, &colours_}, {GL_COLOR_ATTACHMENT1, &surfaces_}}) {
    glNamedFramebufferReadBuffer(framebuffer_.name(), static_cast<GLenum>(part));
    glReadPixels(0, 0, side_, side_, GL_RGBA, GL_UNSIGNED_BYTE, bytes->data());
  }
  tbb::parallel_for(0, kLdmPixels, [&](int y) {
    for (int x = 0; x < kLdmPixels; ++x) {
      LdmSum sum;
      for (int j = 0; j < fine_; ++j)
        for (int i = 0; i < fine_; ++i) {
          const auto at = 4 * (static_cast<std::size_t>(y * fine_ + j) * static_cast<std::size_t>(side_) +
                               static_cast<std::size_t>(x * fine_ + i));
          if (colours_[at + 3] > 0) sum.add(texel_of(&colours_[at], &surfaces_[at]), 1);
        }
      if (sum.weight() == 0) continue;
      const float alpha = 255 * sum.weight() / static_cast<float>(fine_ * fine_);
      image.at(layer, x, y) = sum.mean(static_cast<std::uint8_t>(std::lround(alpha)));
    }
  });
}

LdmImage LdmSamplerGl::operator()(const ParallelView& view, int layers) {
  LdmImage image(layers);
  set_view(view);
  const std::vector<Run> quads = sort_quads(view, layers);
  for (int layer = 0; layer < layers; ++layer) {
    draw_slab(view, layer, layers, quads[static_cast<std::size_t>(layer)]);
    read_slab(layer, image);
  }
  return image;
}

}  // namespace manzana::foliage
