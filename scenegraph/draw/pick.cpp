#include "scenegraph/draw/pick.h"

#include <stdexcept>

#include "gl/vertex_array.h"
#include "manzana_draw_shaders.h"
#include "scenegraph/draw/frame_data.h"

namespace manzana::draw {
namespace {

using Ids = std::vector<std::uint32_t>;

struct IdTarget {
  explicit IdTarget(const PixelRect& rect) {
    GLuint names[2] = {0, 0}, framebuffer = 0;
    glCreateRenderbuffers(2, names);
    ids = gl::Renderbuffer(names[0]);
    depth = gl::Renderbuffer(names[1]);
    glNamedRenderbufferStorage(names[0], GL_R32UI, rect.width, rect.height);
    glNamedRenderbufferStorage(names[1], GL_DEPTH_COMPONENT32F, rect.width, rect.height);
    glCreateFramebuffers(1, &framebuffer);
    target = gl::Framebuffer(framebuffer);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, names[0]);
    glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, names[1]);
    if (glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("the device cannot draw numbers into a rectangle of that size");
  }
  gl::Renderbuffer ids, depth;
  gl::Framebuffer target;
};

/// Spreads the rectangle over the whole of clip space.
Mat4 onto_rect(const Mat4d& clip, Size picture, const PixelRect& rect) {
  const double sx = static_cast<double>(picture.width) / rect.width,
               sy = static_cast<double>(picture.height) / rect.height;
  Mat4d spread(1);
  spread[0][0] = sx;
  spread[1][1] = sy;
  spread[3][0] = sx - (2.0 * rect.x + rect.width) / rect.width;
  spread[3][1] = sy - (2.0 * rect.y + rect.height) / rect.height;
  return Mat4(spread * clip);
}

/// A command for each object and paint, which bears its number.
std::vector<gl::DrawCommand> commands_of(const LayerTable& table, const LayerPieces& layer,
                                         std::span<const culling::ObjectRun> runs) {
  std::vector<gl::DrawCommand> commands;
  for (const culling::ObjectRun& run : runs)
    for (std::uint32_t object = run.first; object < run.last; ++object)
      layer.for_each(table, {object, object + 1}, [&](std::uint32_t piece, const culling::ObjectRun& rows) {
        const auto& held = layer.held[layer.shown[piece].item];
        if (!held) return;
        const std::uint32_t before = layer.pieces[piece].rows.first;
        for (const auto& first : held->first) {
          const std::uint32_t begin = first[rows.first - before], end = first[rows.last - before];
          const auto base = static_cast<GLint>(held->vertices_at);
          if (begin < end) commands.push_back({end - begin, 1, begin, base, object + 1});
        }
      });
  return commands;
}

void draw_mesh_ids(const CityMeshes& meshes, const LayerTable& table, const LayerPieces& layer,
                   std::span<const culling::ObjectRun> runs) {
  const std::vector<gl::DrawCommand> commands = commands_of(table, layer, runs);
  if (commands.empty()) return;
  const gl::Buffer buffer = gl::make_buffer(std::as_bytes(std::span(commands)));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.name());
  glBindVertexArray(meshes.array().name());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands.size()), 0);
}

struct Crown {
  Vec4 foot, up;
  glm::uvec4 id;
};

std::vector<Crown> crowns_of(const Scene& scene, std::span<const culling::ObjectRun> runs, const Vec3d& eye) {
  std::vector<Crown> crowns;
  const std::vector<std::uint32_t>& row = scene.trees.table.row_first;
  for (const culling::ObjectRun& run : runs)
    for (std::uint32_t object = run.first; object < run.last; ++object) {
      if (row[object] == row[object + 1]) continue;
      const TreeInstance& tree = scene.trees.instances[row[object]];
      const BlockFrame& block = scene.blocks[tree.block];
      const Vec3d foot = block.to_local(Vec3d(tree.position)) - eye;
      crowns.push_back(
          {Vec4(Vec3(foot), tree.height_m), Vec4(Vec3(block.axes[2]), tree.crown_radius_m), {object + 1, 0, 0, 0}});
    }
  return crowns;
}

void draw_node_ids(const Pickable& what, const Vec3d& eye) {
  if (what.seen.empty()) return;
  gl::StreamBuffer stream;
  stream.begin(stream_bytes(what.seen));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, stream.name());
  draw_nodes(what.nodes, what.seen, eye, NodeExtra::number, stream);
  stream.end();
}

void draw_tree_ids(const std::vector<Crown>& crowns) {
  if (crowns.empty()) return;
  constexpr GLsizei kVertices = 6 * 10 * 6;  // pick_tree.vert
  const gl::Buffer buffer = gl::make_buffer(std::as_bytes(std::span(crowns)));
  const gl::VertexArray nothing = gl::make_vertex_array();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, buffer.name());
  glBindVertexArray(nothing.name());
  glDrawArraysInstanced(GL_TRIANGLES, 0, kVertices, static_cast<GLsizei>(crowns.size()));
}

gl::Program make_pass(std::string_view name, std::string_view vertex) {
  return gl::make_program(name, {shaders::version_glsl, vertex}, {shaders::version_glsl, shaders::pick_frag});
}

void use(const gl::Program& program, const Mat4& clip) {
  glUseProgram(program.name());
  glUniformMatrix4fv(0, 1, GL_FALSE, &clip[0].x);
}

void begin(const IdTarget& target, const PixelRect& rect) {
  const GLuint none[4] = {0, 0, 0, 0};
  const float farthest = 0;
  glBindFramebuffer(GL_FRAMEBUFFER, target.target.name());
  glClearBufferuiv(GL_COLOR, 0, none);
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  glViewport(0, 0, rect.width, rect.height);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
}

Ids read(const PixelRect& rect) {
  Ids ids(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, rect.width, rect.height, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
  return ids;
}

}  // namespace

PickPrograms::PickPrograms()
    : meshes(make_pass("pick_mesh", shaders::pick_mesh_vert)),
      trees(make_pass("pick_tree", shaders::pick_tree_vert)),
      nodes(make_pass("pick_node", shaders::pick_node_vert)) {}

Ids pick_objects(const PickPrograms& programs, const Pickable& what, const Camera& camera, Size picture,
                 const PixelRect& rect) {
  const IdTarget target(rect);
  const Mat4 clip = onto_rect(camera.view_projection, picture, rect);
  const std::span<const culling::ObjectRun> runs = what.sets.objects();
  std::vector<Rows> rows;
  for (const BlockFrame& block : what.scene.blocks) rows.push_back(relative_to(camera.eye, block));
  const gl::Buffer blocks = gl::make_buffer(std::as_bytes(std::span(rows)));
  begin(target, rect);
  use(programs.meshes, clip);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, blocks.name());
  draw_mesh_ids(what.meshes, what.scene.buildings.table, what.meshes.buildings, runs);
  draw_mesh_ids(what.meshes, what.scene.surfaces.table, what.meshes.surfaces, runs);
  use(programs.nodes, clip);
  draw_node_ids(what, camera.eye);
  use(programs.trees, clip);
  draw_tree_ids(crowns_of(what.scene, runs, camera.eye));
  return read(rect);
}

}  // namespace manzana::draw
