#include "scenegraph/draw/node_layer.h"

#include "foliage/leaf_image.h"
#include "manzana_draw_shaders.h"

namespace manzana::draw {
namespace {

std::size_t bytes_of(const NodeMesh& mesh) {
  return std::as_bytes(std::span(mesh.vertices)).size() + std::as_bytes(std::span(mesh.indices)).size();
}

MeshSet upload(const NodeMesh& mesh) {
  return make_mesh_set(mesh.vertices, mesh.indices, {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}});
}

Vec4 paint_of(const SeenNode& node) { return node.colour ? Vec4(foliage::linear_of_rgb(*node.colour), 1) : Vec4(0); }
Vec4 number_of(const SeenNode& node) {
  return {static_cast<float>(node.id & 0xFFFFU), static_cast<float>(node.id >> 16), 0, 0};
}

Rows relative_to(const Vec3d& eye, const Mat4d& m) {
  Rows rows;
  for (int i = 0; i < 3; ++i)
    rows[static_cast<std::size_t>(i)] = Vec4(glm::dvec4(m[0][i], m[1][i], m[2][i], m[3][i] - eye[i]));
  return rows;
}

/// Nodes of one mesh.
struct Share {
  const MeshSet* meshes;
  InstanceBins bins{1};
  std::vector<const SeenNode*> nodes;
};

/// In the order in which meshes first come.
std::vector<Share> by_mesh(const NodeLayerGpu& layer, std::span<const SeenNode> seen) {
  std::vector<Share> shares;
  std::map<const MeshSet*, std::size_t> known;
  for (const SeenNode& node : seen) {
    const MeshSet* meshes = layer.find(node.mesh);
    if (meshes == nullptr) continue;
    const auto [at, is_new] = known.emplace(meshes, shares.size());
    if (is_new) shares.push_back({meshes, InstanceBins(1), {}});
    shares[at->second].nodes.push_back(&node);
    ++shares[at->second].bins.count[0];
  }
  return shares;
}

}  // namespace

std::size_t NodeLayerGpu::bring(std::span<const SeenNode> seen, std::size_t most_bytes) {
  drop_unused();
  std::size_t left = 0, brought = 0;
  for (const SeenNode& node : seen) {
    if (held_.contains(node.mesh)) continue;
    const std::size_t bytes = bytes_of(*node.mesh);
    if (brought > 0 && brought + bytes > most_bytes) {
      left += bytes;
      continue;
    }
    held_.emplace(node.mesh, Held{upload(*node.mesh), bytes});
    brought += bytes;
    bytes_ += bytes;
  }
  return left;
}

void NodeLayerGpu::drop_unused() {
  std::erase_if(held_, [&](const auto& item) {
    if (!item.first.expired()) return false;
    bytes_ -= item.second.bytes;
    return true;
  });
}

const MeshSet* NodeLayerGpu::find(const std::shared_ptr<const NodeMesh>& mesh) const {
  const auto found = held_.find(mesh);
  return found == held_.end() ? nullptr : &found->second.meshes;
}

gl::Program make_node_program() {
  using namespace shaders;
  return gl::make_program("node", {version_glsl, frame_layout_glsl, frame_glsl, light_glsl, node_vert},
                          {version_glsl, frame_layout_glsl, frame_glsl, light_glsl, node_frag});
}

std::size_t stream_bytes(std::span<const SeenNode> seen) {  // at worst each has a mesh of its own
  return seen.size() * (gl::StreamBuffer::padded(sizeof(Instance)) + gl::StreamBuffer::padded(sizeof(gl::DrawCommand)));
}

Drawn draw_nodes(const NodeLayerGpu& layer, std::span<const SeenNode> seen, const Vec3d& eye, NodeExtra extra,
                 gl::StreamBuffer& stream) {
  Drawn drawn;
  for (const Share& share : by_mesh(layer, seen)) {
    const auto instances = stream.take<Instance>(share.nodes.size());
    for (std::size_t i = 0; i < share.nodes.size(); ++i)
      instances.items[i] = {relative_to(eye, share.nodes[i]->placement),
                            extra == NodeExtra::paint ? paint_of(*share.nodes[i]) : number_of(*share.nodes[i])};
    const Drawn part = draw_instances(*share.meshes, share.bins, stream, instances.offset);
    drawn.triangles += part.triangles;
    drawn.commands += part.commands;
  }
  return drawn;
}

}  // namespace manzana::draw
