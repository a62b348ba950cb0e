#include "scenegraph/draw/instances.h"

#include <algorithm>
#include <numeric>

#include "gl/vertex_array.h"

namespace manzana::draw {
namespace {

constexpr GLuint kMeshBinding = 0, kInstanceBinding = 1, kFirstInstanceAttribute = 4;

void describe_instances(GLuint array) {
  for (GLuint i = 0; i < 4; ++i) {
    const GLuint attribute = kFirstInstanceAttribute + i;
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribFormat(array, attribute, 4, GL_FLOAT, GL_FALSE, i * static_cast<GLuint>(sizeof(Vec4)));
    glVertexArrayAttribBinding(array, attribute, kInstanceBinding);
  }
  glVertexArrayBindingDivisor(array, kInstanceBinding, 1);
}

void describe_vertices(GLuint array) {
  for (GLuint attribute = 0; attribute < 3; ++attribute) {
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribBinding(array, attribute, kMeshBinding);
  }
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribFormat(array, 1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, 12);
  glVertexArrayAttribIFormat(array, 2, 1, GL_UNSIGNED_INT, 16);
}

}  // namespace

MeshSet make_mesh_set(std::span<const std::byte> vertices, std::span<const std::uint32_t> indices,
                      std::vector<MeshRange> meshes) {
  MeshSet set;
  set.vertices = gl::make_buffer(vertices);
  set.indices = gl::make_buffer(std::as_bytes(indices));
  set.meshes = std::move(meshes);
  set.array = gl::make_vertex_array(set.indices);
  glVertexArrayVertexBuffer(set.array.name(), kMeshBinding, set.vertices.name(), 0, kMeshVertexBytes);
  describe_vertices(set.array.name());
  describe_instances(set.array.name());
  return set;
}

void InstanceBins::clear() { std::fill(count.begin(), count.end(), 0U); }
std::uint32_t InstanceBins::total() const { return std::accumulate(count.begin(), count.end(), 0U); }
void InstanceBins::start() { std::exclusive_scan(count.begin(), count.end(), next.begin(), 0U); }

std::size_t stream_bytes(const MeshSet& set, std::size_t instances) {
  return gl::StreamBuffer::padded(instances * sizeof(Instance)) +
         gl::StreamBuffer::padded(set.meshes.size() * sizeof(gl::DrawCommand));
}

Drawn draw_instances(const MeshSet& set, const InstanceBins& bins, gl::StreamBuffer& stream, std::intptr_t offset) {
  const auto commands = stream.take<gl::DrawCommand>(set.meshes.size());
  Drawn drawn;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < set.meshes.size(); first += bins.count[i++]) {
    if (bins.count[i] == 0) continue;
    const MeshRange& mesh = set.meshes[i];
    commands.items[drawn.commands++] = {mesh.indices, bins.count[i], mesh.first_index, mesh.base_vertex, first};
    drawn.triangles += std::uint64_t{mesh.indices / 3} * bins.count[i];
  }
  if (drawn.commands == 0) return drawn;
  glVertexArrayVertexBuffer(set.array.name(), kInstanceBinding, stream.name(), offset, sizeof(Instance));
  glBindVertexArray(set.array.name());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(commands.offset),
                              static_cast<GLsizei>(drawn.commands), 0);
  return drawn;
}

}  // namespace manzana::draw
