#pragma once
/// Nodes of a host on the GPU: a mesh is uploaded when it is first seen and goes when no node has it any more; the
/// nodes that share it are one draw.
///   layer.bring(seen, most_bytes);                       // meshes that are missing, some a frame
///   Drawn drawn = draw_nodes(layer, program, seen, eye, stream);
#include <map>
#include <memory>

#include "gl/buffer.h"
#include "gl/program.h"
#include "scenegraph/draw/instances.h"
#include "scenegraph/nodes.h"

namespace manzana::draw {

class NodeLayerGpu {
 public:
  /// At most so many bytes, but for a mesh that is larger by itself; returns how many are left.
  std::size_t bring(std::span<const SeenNode> seen, std::size_t most_bytes);
  /// nullptr: not there yet.
  const MeshSet* find(const std::shared_ptr<const NodeMesh>& mesh) const;
  std::size_t device_bytes() const { return bytes_; }

 private:
  void drop_unused();
  struct Held {
    MeshSet meshes;
    std::size_t bytes;
  };
  std::map<std::weak_ptr<const NodeMesh>, Held, std::owner_less<>> held_;
  std::size_t bytes_ = 0;
};

/// What is written as Instance::extra.
enum class NodeExtra : std::uint8_t { paint, number };

gl::Program make_node_program();
std::size_t stream_bytes(std::span<const SeenNode> seen);
/// With a program in use that reads instances; nodes whose mesh is missing are left out.
Drawn draw_nodes(const NodeLayerGpu& layer, std::span<const SeenNode> seen, const Vec3d& eye, NodeExtra extra,
                 gl::StreamBuffer& stream);

}  // namespace manzana::draw
