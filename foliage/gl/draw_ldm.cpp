#include "foliage/gl/draw_ldm.h"

#include <algorithm>
#include <utility>

#include "foliage/gl/stream_lists.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

// Those of plants that only extraction asks for.
enum LdmBinding : GLuint { kTrees = 4, kItems, kGroups, kSides, kBlocks = 10, kMosaics };
constexpr std::uint32_t kGroupsOfDraw = 8192;

gl::Program make_program(const char* name, const HostShaders& host, const std::string& define, const gl::Pieces& ways) {
  using namespace shaders;
  gl::Pieces vertex{version_glsl, hash_glsl, ldm_layout_glsl, ldm_turn_glsl},
      pixels{version_glsl, define, hash_glsl, tree_share_glsl, ldm_glsl};
  vertex.insert(vertex.end(), host.vertex.begin(), host.vertex.end());
  vertex.insert(vertex.end(), {sway_glsl, ldm_vert});
  pixels.insert(pixels.end(), ways.begin(), ways.end());
  pixels.insert(pixels.end(), host.mosaics.begin(), host.mosaics.end());
  return gl::make_program(name, vertex, pixels);
}

}  // namespace

LdmPrograms::LdmPrograms(const HostShaders& dithered_host, const HostShaders& blended_host)
    : host(dithered_host),
      blended(make_program("ldm_blended", blended_host, {}, {shaders::ldm_blend_glsl})),
      sum(gl::make_program("ldm_sum", {shaders::version_glsl, shaders::ldm_sum_vert},
                           {shaders::version_glsl, shaders::ldm_sum_frag})),
      indices(make_quad_indices(kGroupsOfDraw * glsl::kLdmGroup)),
      array(gl::make_vertex_array(indices)) {}

const gl::Program& LdmPrograms::dithered(int samples) {
  const auto at = by_samples.find(samples);
  if (at != by_samples.end()) return at->second;
  gl::Program program = make_program("ldm_dithered", host, define_samples(samples), {shaders::ldm_dither_glsl});
  return by_samples.emplace(samples, std::move(program)).first->second;
}

LdmDrawer::LdmDrawer(std::span<const LdmPack> packs, std::shared_ptr<LdmPrograms> programs)
    : store_(packs), programs_(std::move(programs)) {}

void LdmDrawer::begin(const gl::Program& program, const LdmSelection& chosen) {
  glUseProgram(program.name());
  glBindVertexArray(programs_->array.name());
  glBindTextureUnit(0, store_.colours.name());
  glBindTextureUnit(1, store_.surfaces.name());
  stream_.begin(room_for(chosen.trees) + room_for(chosen.items) + room_for(chosen.groups));
  bind_list(stream_, kTrees, chosen.trees);
  bind_list(stream_, kItems, chosen.items);
  bind_list(stream_, kGroups, chosen.groups);
  for (const auto& [binding, buffer] :
       {std::pair{kSides, &store_.sides}, {kBlocks, &store_.blocks}, {kMosaics, &store_.mosaics}})
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer->name());
}

void LdmDrawer::draw(const Run& groups) const {
  for (std::uint32_t first = groups.first; first < groups.last; first += kGroupsOfDraw) {
    const std::uint32_t count = std::min(kGroupsOfDraw, groups.last - first);
    glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(6 * glsl::kLdmGroup * count), GL_UNSIGNED_INT, nullptr,
                             static_cast<GLint>(4 * glsl::kLdmGroup * first));
  }
}

void LdmDrawer::draw_dithered(const LdmSelection& chosen, int samples, const Wind& wind) {
  begin(programs_->dithered(samples), chosen);
  set_wind(wind);
  draw({0, static_cast<std::uint32_t>(chosen.groups.size())});
  stream_.end();
}

LdmDrawer::Layer LdmDrawer::make_layer(int width, int height) {
  GLuint colour = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &colour);
  Layer layer{width, height, gl::Texture(colour), {}};
  glTextureStorage2D(colour, 1, GL_RGBA16F, width, height);
  glCreateFramebuffers(1, &framebuffer);
  layer.framebuffer = gl::Framebuffer(framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, colour, 0);
  return layer;
}

void LdmDrawer::add_up(const Layer& from, GLuint to, GLenum times_behind) const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlendFunc(GL_ONE, times_behind);
  glUseProgram(programs_->sum.name());
  glBindTextureUnit(0, from.colour.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void LdmDrawer::draw_blended(const LdmSelection& chosen, int width, int height) {
  if (part_.width != width || part_.height != height)
    part_ = make_layer(width, height), all_ = make_layer(width, height);
  GLint target = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  const Vec4 nothing{0};
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glClearNamedFramebufferfv(all_.framebuffer.name(), GL_COLOR, 0, &nothing.x);
  begin(programs_->blended, chosen);
  for (const Run& rank : chosen.ranks) {
    if (rank.size() == 0) continue;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, part_.framebuffer.name());
    glClearNamedFramebufferfv(part_.framebuffer.name(), GL_COLOR, 0, &nothing.x);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC1_ALPHA);
    glUseProgram(programs_->blended.name());
    glBindTextureUnit(0, store_.colours.name());
    draw(rank);
    add_up(part_, all_.framebuffer.name(), GL_ONE);
  }
  stream_.end();
  add_up(all_, static_cast<GLuint>(target), GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace manzana::foliage
