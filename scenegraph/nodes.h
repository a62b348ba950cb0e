#pragma once
/// What a host puts into a city that is shown: planned buildings, masts, machines, whatever stands or moves. Nodes hang
/// in trees of their own, as in any scene graph: where one stands, whether it shows and what colour it is painted holds
/// for all below it. Meshes are shared by as many nodes as one likes. A layer is a node without a mesh.
///   auto nodes = model->new_nodes();
///   const NodeId plan = nodes->add({.name = "variant A"});                      // a layer
///   const NodeId house = add_model(*nodes, read_model("house.glb"), {plan, upright(frame, place)});
///   view.show(model, nodes);                                                        // manzana/view.h
///   nodes->move(house, upright(frame, elsewhere));   nodes->show(plan, false);      // between frames
/// Found by the city's own BqR-Tree, of which there is a copy here: each node with a mesh that shows is a block of it,
/// put in, moved and taken out by culling/bqr_edit.h; a node that does not show costs a query nothing. A change costs
/// O(depth) for each node below. Frame: L, metres.
/// Threads: changes from one at a time, while no view that shows it is updated. Errors: std::invalid_argument for a
/// number that no node has, a cycle, or a place that is not finite; nothing has changed then.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "culling/bqr_edit.h"
#include "scenegraph/scene.h"

namespace manzana {

/// Never given twice, and no feature of the city has it: the first is one more than the city's objects. 0: none.
using NodeId = std::uint32_t;

/// 20 bytes. Position in the mesh's own frame, metres, z up; normal as CityVertex has it; sRGB red | green << 8 | blue
/// << 16.
struct NodeVertex {
  Vec3 position;
  std::uint32_t normal;
  std::uint32_t colour;
};

struct NodeMesh {
  std::vector<NodeVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< triangles, seen from both sides
};

struct NewNode {
  NodeId parent = 0;
  Mat4d placement{1};  ///< in the parent's frame, without one in L: affine
  std::shared_ptr<const NodeMesh> mesh = {};
  std::optional<std::uint32_t> colour = {};  ///< 0xRRGGBB, of all below; none: the parent's, or the mesh's own
  bool shown = true;
  std::string name = {};
};

/// What a query found of nodes, to be drawn.
struct SeenNode {
  NodeId id = 0;
  std::shared_ptr<const NodeMesh> mesh;
  Mat4d placement{1};  ///< in L
  std::optional<std::uint32_t> colour;
};

class Nodes {
 public:
  explicit Nodes(const Scene& scene);
  Nodes(const Nodes&) = delete;
  Nodes& operator=(const Nodes&) = delete;

  NodeId add(NewNode node);
  void move(NodeId id, const Mat4d& placement);
  void hang(NodeId id, NodeId parent);  ///< elsewhere, its placement being in the new parent's frame
  void show(NodeId id, bool shown);
  void paint(NodeId id, std::optional<std::uint32_t> colour);
  void remove(NodeId id);  ///< and all below

  /// Other classes for the city's objects, by number: any bits but kNode and kCar, which stay what they are. For
  /// View::show_only.
  void classify(const std::function<culling::ClassMask(std::uint32_t object)>& class_of);

  bool contains(NodeId id) const { return slot_of(id) != kNone; }
  std::size_t size() const { return size_; }
  /// As it was added, or changed since.
  const NewNode& node(NodeId id) const { return at(id).own; }
  const std::vector<NodeId>& children(NodeId id) const { return at(id).children; }
  Mat4d placement(NodeId id) const { return at(id).placement; }  ///< in L
  bool visible(NodeId id) const { return at(id).visible; }       ///< it shows, and all above it
  /// Of it and all below that have a mesh, shown or not, in L; empty without any.
  culling::BoxD box(NodeId id) const;

  /// The city's and the nodes'; objects below first_object() are the city's.
  const culling::BqrTree& tree() const { return tree_; }
  std::uint32_t first_object() const { return first_object_; }
  std::uint32_t city_blocks() const { return blocks_; }
  /// Of runs of nodes' objects; in the order of their numbers, so that a picture does not tell in what order things
  /// were done.
  void find(std::span<const culling::ObjectRun> objects, std::vector<SeenNode>& seen) const;

 private:
  static constexpr std::uint32_t kNone = ~0U;
  struct Slot {
    NewNode own;
    std::vector<NodeId> children;
    NodeId id = 0;
    Mat4d placement{1};
    std::optional<std::uint32_t> colour;
    bool visible = true, in_tree = false;
    culling::BoxD mesh_box;       ///< in its own frame
    std::uint32_t block = kNone;  ///< of the tree, while it has one
    culling::Room room;
  };
  std::uint32_t slot_of(NodeId id) const;
  Slot& at(NodeId id);
  const Slot& at(NodeId id) const;
  std::uint32_t new_slot();
  void refresh(NodeId id);
  void inherit(Slot& slot) const;
  void put_into_tree(Slot& slot);
  void take_from_tree(Slot& slot);
  void unhang(NodeId id);

  culling::BqrTree tree_;
  std::uint32_t first_object_, blocks_;  ///< of the city
  NodeId first_id_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_slots_, slots_by_id_, slot_of_object_;
  struct Place {
    std::uint32_t block;
    culling::Room room;
  };
  std::vector<Place> free_places_;  ///< that nodes left in the tree
  std::size_t size_ = 0;
};

/// A second one of it and all below, with the same meshes.
NodeId add_copy(Nodes& nodes, NodeId id, NodeId parent, const Mat4d& placement);

/// Upright on the ground at a place in L, turned about up from north to east, in radians.
Mat4d upright(const LocalFrame& frame, const Vec3d& place, double turn = 0);

}  // namespace manzana
