#include "scenegraph/nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <stdexcept>
#include <utility>

namespace manzana {
namespace {

using culling::BoxD;

// The GPU multiplies in float: a vertex may come out some units in the last place farther.
constexpr double kSlack = 1e-6;
constexpr double kFarthest = 1e9;  // metres; nothing on Earth is

BoxD box_of(const NodeMesh& mesh) {
  BoxD box;
  for (const NodeVertex& v : mesh.vertices) box = merge(box, Vec3d(v.position));
  return box;
}

BoxD placed(const BoxD& box, const Mat4d& m) {
  if (box.empty()) return {};
  BoxD out;
  for (unsigned corner = 0; corner < 8; ++corner)
    out = merge(out, Vec3d(m * glm::dvec4((corner & 1U) != 0 ? box.max.x : box.min.x,
                                          (corner & 2U) != 0 ? box.max.y : box.min.y,
                                          (corner & 4U) != 0 ? box.max.z : box.min.z, 1)));
  return out;
}

bool near(const Vec3d& p) { return glm::all(glm::lessThanEqual(glm::abs(p), Vec3d(kFarthest))); }

bool near(const Mat4d& m) { return near(Vec3d(m[0])) && near(Vec3d(m[1])) && near(Vec3d(m[2])) && near(Vec3d(m[3])); }

void refuse_bad(const Mat4d& m) {
  if (!near(m) || glm::row(m, 3) != glm::dvec4(0, 0, 0, 1))
    throw std::invalid_argument("a node's placement is not affine, not finite or too far");
}

void refuse_bad(const NodeMesh& mesh) {
  for (const NodeVertex& v : mesh.vertices)
    if (!near(Vec3d(v.position))) throw std::invalid_argument("a node's mesh is not finite or too large");
  for (const std::uint32_t i : mesh.indices)
    if (i >= mesh.vertices.size()) throw std::invalid_argument("a node's mesh has an index beyond its vertices");
}

}  // namespace

Nodes::Nodes(const Scene& scene)
    : tree_(scene.tree), blocks_(scene.tree.blocks()), first_id_(scene.tree.objects() + 1) {
  // A number that nobody has, so that no run holds the city's last object and the first of a node.
  tree_.object_order.push_back(tree_.objects());
  if (!tree_.classes.empty()) tree_.classes.push_back(0);
  first_object_ = tree_.objects();
}

std::uint32_t Nodes::slot_of(NodeId id) const {
  return id < first_id_ || id - first_id_ >= slots_by_id_.size() ? kNone : slots_by_id_[id - first_id_];
}

const Nodes::Slot& Nodes::at(NodeId id) const {
  const std::uint32_t slot = slot_of(id);
  if (slot == kNone) throw std::invalid_argument("no node has the number " + std::to_string(id));
  return slots_[slot];
}
Nodes::Slot& Nodes::at(NodeId id) { return const_cast<Slot&>(std::as_const(*this).at(id)); }

std::uint32_t Nodes::new_slot() {
  if (free_slots_.empty()) {
    slots_.emplace_back();
    return static_cast<std::uint32_t>(slots_.size() - 1);
  }
  const std::uint32_t slot = free_slots_.back();
  free_slots_.pop_back();
  return slot;
}

NodeId Nodes::add(NewNode node) {
  refuse_bad(node.placement);
  if (node.mesh) refuse_bad(*node.mesh);
  if (node.parent != 0) (void)at(node.parent);
  const NodeId id = first_id_ + static_cast<NodeId>(slots_by_id_.size());
  const std::uint32_t slot = new_slot();
  slots_by_id_.push_back(slot);
  slots_[slot].own = std::move(node);
  slots_[slot].id = id;
  if (slots_[slot].own.mesh) slots_[slot].mesh_box = box_of(*slots_[slot].own.mesh);
  if (slots_[slot].own.parent != 0) at(slots_[slot].own.parent).children.push_back(id);
  ++size_;
  refresh(id);
  return id;
}

void Nodes::move(NodeId id, const Mat4d& placement) {
  refuse_bad(placement);
  at(id).own.placement = placement;
  refresh(id);
}

void Nodes::hang(NodeId id, NodeId parent) {
  at(id);
  for (NodeId above = parent; above != 0; above = at(above).own.parent)
    if (above == id) throw std::invalid_argument("a node cannot hang below itself");
  unhang(id);
  at(id).own.parent = parent;
  if (parent != 0) at(parent).children.push_back(id);
  refresh(id);
}

void Nodes::show(NodeId id, bool shown) {
  if (std::exchange(at(id).own.shown, shown) != shown) refresh(id);
}

void Nodes::paint(NodeId id, std::optional<std::uint32_t> colour) {
  at(id).own.colour = colour;
  refresh(id);
}

void Nodes::classify(const std::function<culling::ClassMask(std::uint32_t)>& class_of) {
  std::vector<culling::ClassMask> classes(tree_.objects(), kNode);
  for (std::uint32_t object = 0; object + 1 < first_object_; ++object)
    classes[object] = class_of(object) & static_cast<culling::ClassMask>(~(kNode | kCar));
  std::vector<culling::ClassMask> besides(tree_.blocks(), 0);
  for (std::uint32_t block = 0; block < blocks_; ++block)
    besides[block] =
        tree_.nodes[tree_.place[block] / culling::kLanes].classes[tree_.place[block] % culling::kLanes] & kCar;
  set_classes(tree_, classes, besides);
}

void Nodes::unhang(NodeId id) {
  if (at(id).own.parent != 0) std::erase(at(at(id).own.parent).children, id);
}

void Nodes::remove(NodeId id) {
  unhang(id);
  for (std::vector<NodeId> todo{id}; !todo.empty();) {
    const NodeId next = todo.back();
    todo.pop_back();
    Slot& slot = at(next);
    todo.insert(todo.end(), slot.children.begin(), slot.children.end());
    take_from_tree(slot);
    if (slot.block != kNone) free_places_.push_back({slot.block, slot.room});
    free_slots_.push_back(std::exchange(slots_by_id_[next - first_id_], kNone));
    slot = {};
    --size_;
  }
}

void Nodes::inherit(Slot& slot) const {
  const Slot* parent = slot.own.parent != 0 ? &at(slot.own.parent) : nullptr;
  slot.placement = parent != nullptr ? parent->placement * slot.own.placement : slot.own.placement;
  slot.visible = slot.own.shown && (parent == nullptr || parent->visible);
  slot.colour = slot.own.colour || parent == nullptr ? slot.own.colour : parent->colour;
}

/// Of it and all below: what they inherit, and their places in the tree.
void Nodes::refresh(NodeId id) {
  for (std::vector<NodeId> todo{id}; !todo.empty();) {
    Slot& slot = at(todo.back());
    todo.pop_back();
    const Mat4d before = slot.placement;
    inherit(slot);
    if (slot.in_tree && (!slot.visible || before != slot.placement)) take_from_tree(slot);
    if (slot.visible && !slot.in_tree && !slot.mesh_box.empty()) put_into_tree(slot);
    todo.insert(todo.end(), slot.children.begin(), slot.children.end());
  }
}

void Nodes::put_into_tree(Slot& slot) {
  BoxD box = placed(slot.mesh_box, slot.placement);
  if (!near(slot.placement) || !near(box.min) || !near(box.max)) return;  // no camera on Earth sees it
  box = {box.min - kSlack * (box.max - box.min), box.max + kSlack * (box.max - box.min)};
  const culling::BlockVolume volume{Vec2d(center(box)), box, enclosing_sphere(box)};
  const culling::ClassMask kind = kNode;
  const culling::NewObjects object{{&box, 1}, {&kind, 1}};
  if (slot.block == kNone && !free_places_.empty()) {
    slot.block = free_places_.back().block;
    slot.room = free_places_.back().room;
    free_places_.pop_back();
  }
  if (slot.block != kNone) {
    change_block(tree_, slot.block, volume, object, slot.room);
  } else {
    slot.block = insert_block(tree_, volume, object);
    slot.room.first = tree_.block_objects[slot.block].first;
    slot_of_object_.resize(tree_.objects() - first_object_);
  }
  slot_of_object_[slot.room.first - first_object_] = slot_of(slot.id);
  slot.in_tree = true;
}

void Nodes::take_from_tree(Slot& slot) {
  if (slot.in_tree) slot.room = remove_block(tree_, slot.block);
  slot.in_tree = false;
}

BoxD Nodes::box(NodeId id) const {
  BoxD all;
  for (std::vector<NodeId> todo{id}; !todo.empty();) {
    const Slot& slot = at(todo.back());
    todo.pop_back();
    all = merge(all, placed(slot.mesh_box, slot.placement));
    todo.insert(todo.end(), slot.children.begin(), slot.children.end());
  }
  return all;
}

void Nodes::find(std::span<const culling::ObjectRun> objects, std::vector<SeenNode>& seen) const {
  std::vector<NodeId> ids;
  for (const culling::ObjectRun& run : objects)
    for (std::uint32_t object = run.first; object < run.last; ++object)
      ids.push_back(slots_[slot_of_object_[object - first_object_]].id);
  std::sort(ids.begin(), ids.end());
  seen.clear();
  for (const NodeId id : ids) {
    const Slot& slot = at(id);
    seen.push_back({id, slot.own.mesh, slot.placement, slot.colour});
  }
}

NodeId add_copy(Nodes& nodes, NodeId id, NodeId parent, const Mat4d& placement) {
  NewNode copy = nodes.node(id);
  copy.parent = parent;
  copy.placement = placement;
  const std::vector<NodeId> children = nodes.children(id);  // as they were: the copy may hang below one of them
  const NodeId added = nodes.add(std::move(copy));
  for (const NodeId child : children) add_copy(nodes, child, added, nodes.node(child).placement);
  return added;
}

Mat4d upright(const LocalFrame& frame, const Vec3d& place, double turn) {
  const BlockFrame block = block_frame(frame, Vec2d(place));
  const double c = std::cos(turn), s = std::sin(turn);
  Mat4d m(1);
  m[0] = glm::dvec4(c * block.axes[0] - s * block.axes[1], 0);
  m[1] = glm::dvec4(s * block.axes[0] + c * block.axes[1], 0);
  m[2] = glm::dvec4(block.axes[2], 0);
  m[3] = glm::dvec4(place, 1);
  return m;
}

}  // namespace manzana
