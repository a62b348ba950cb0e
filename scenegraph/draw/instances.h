#pragma once
/// Many copies of few meshes: all meshes in one pair of buffers, instances sorted by mesh in the frame's stream, one
/// multi-draw. For trees and cars.
///   MeshSet set = make_mesh_set(...);                            // once
///   Instance* slots = begin_instances(counts, stream, draw);    // sorted places: bin b starts at draw.first[b]
///   draw_instances(set, draw, stream);
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "scenegraph/draw/frame_data.h"

namespace manzana::draw {

/// 64 bytes: where a copy stands, relative to the eye, and four numbers for its shader.
struct Instance {
  Rows rows;
  Vec4 extra{0, 0, 0, 0};
};
static_assert(sizeof(Instance) == 64);

struct MeshRange {
  std::uint32_t first_index = 0, indices = 0;
  std::int32_t base_vertex = 0;
};

/// Meshes resident on the GPU. Attributes 0 to 2: position, normal, a word of the owner's; 4 to 7 are the instance's.
struct MeshSet {
  gl::VertexArray array;
  gl::Buffer vertices, indices;
  std::vector<MeshRange> meshes;
};
/// Of vertices that are a Vec3, a signed normalised 10-10-10-2 and a word.
inline constexpr std::size_t kMeshVertexBytes = 20;
MeshSet make_mesh_set(std::span<const std::byte> vertices, std::span<const std::uint32_t> indices,
                      std::vector<MeshRange> meshes);
template <class Vertex>
MeshSet make_mesh_set(const std::vector<Vertex>& vertices, std::span<const std::uint32_t> indices,
                      std::vector<MeshRange> meshes) {
  static_assert(sizeof(Vertex) == kMeshVertexBytes && offsetof(Vertex, normal) == 12);
  return make_mesh_set(std::as_bytes(std::span(vertices)), indices, std::move(meshes));
}

/// Instances of a frame by mesh: counting sort. Reserved once.
struct InstanceBins {
  std::vector<std::uint32_t> count;  ///< a row a mesh
  std::vector<std::uint32_t> next;   ///< where the next instance of that mesh goes
  explicit InstanceBins(std::size_t meshes) : count(meshes), next(meshes) {}
  void clear();
  std::uint32_t total() const;
  void start();  ///< counts -> next
};

struct Drawn {
  std::uint64_t triangles = 0, commands = 0;
};
std::size_t stream_bytes(const MeshSet& set, std::size_t instances);
/// `offset`: of the first instance in the stream. Needs stream room for a command a mesh.
Drawn draw_instances(const MeshSet& set, const InstanceBins& bins, gl::StreamBuffer& stream, std::intptr_t offset);

}  // namespace manzana::draw
