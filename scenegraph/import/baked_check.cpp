#include "scenegraph/import/baked_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "culling/pack.h"

namespace manzana {
namespace {

using culling::BqrNode;
using culling::BqrTree;
using culling::kLanes;
using culling::kPacket;
using Indices = std::vector<std::uint32_t>;

void need(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(std::string("is damaged: ") + what);
}

bool finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Begins with 0, rises, and ends with `last`.
bool is_prefix(const Indices& first, std::size_t rows, std::size_t last) {
  return first.size() == rows + 1 && first[0] == 0 && first[rows] == last && std::is_sorted(first.begin(), first.end());
}
bool all_below(std::span<const std::uint32_t> values, std::size_t end) {
  return std::ranges::all_of(values, [&](std::uint32_t v) { return v < end; });
}

/// Nodes in the order in which they lie: a child comes after its parent, and each is reached once.
class TreeCheck {
 public:
  explicit TreeCheck(const BqrTree& tree) : tree_(tree), ends_(tree.nodes.size()) {}

  void run() {
    const std::size_t objects = tree_.objects(), blocks = tree_.blocks();
    need(tree_.spare.empty() && tree_.root == 0, "the tree's root");
    need(finite(tree_.origin) && std::isfinite(tree_.reach) && tree_.reach >= 0, "the tree's origin");
    need(tree_.place.size() == blocks && tree_.order.size() == blocks, "the tree's blocks");
    need(all_below(tree_.order, blocks) && all_below(tree_.object_order, objects), "the tree's order");
    need(tree_.classes.empty() || tree_.classes.size() == objects + kPacket, "the tree's classes");
    need(tree_.nodes.empty() == (blocks == 0), "the tree's nodes");
    if (tree_.nodes.empty()) return need(objects == 0, "the tree's objects");
    ends_[0] = {true, 0, static_cast<std::uint32_t>(blocks), 0, static_cast<std::uint32_t>(objects)};
    for (std::uint32_t at = 0; at < tree_.nodes.size(); ++at) check(at);
  }

 private:
  struct Ends {
    bool reached = false;
    std::uint32_t first_block = 0, last_block = 0, first = 0, last = 0;
  };

  void check(std::uint32_t at) {
    const BqrNode& node = tree_.nodes[at];
    Ends rest = ends_[at];
    need(rest.reached, "a node of the tree is not reached");
    need(at != 0 || node.parent == 0, "the tree's root");
    need(finite(Vec3d(node.corner)) && std::isfinite(node.step) && node.step > 0 && node.shift < 16, "a lattice");
    need((node.blocks & ~node.lanes) == 0 && node.whole == node.lanes && node.ordered, "a node's lanes");
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      if ((node.lanes >> i & 1) == 0) continue;
      need(node.first_block[i] == rest.first_block && node.first[i] == rest.first, "runs do not follow each other");
      need(node.last_block[i] > rest.first_block && node.last_block[i] <= rest.last_block, "a run of blocks");
      need(node.last[i] >= rest.first && node.last[i] <= rest.last, "a run of objects");
      (node.blocks >> i & 1) != 0 ? check_block(at, i) : check_child(at, i);
      rest.first_block = node.last_block[i];
      rest.first = node.last[i];
    }
    need(rest.first_block == rest.last_block && rest.first == rest.last, "runs do not fill their node");
  }

  void check_child(std::uint32_t at, std::uint32_t i) {
    const BqrNode& node = tree_.nodes[at];
    const std::uint32_t child = node.child[i];
    need(child > at && child < ends_.size() && !ends_[child].reached, "a node is reached twice");
    need(tree_.nodes[child].parent == at, "a node's parent");
    ends_[child] = {true, node.first_block[i], node.last_block[i], node.first[i], node.last[i]};
  }

  void check_block(std::uint32_t at, std::uint32_t i) const {
    const BqrNode& node = tree_.nodes[at];
    const std::uint32_t block = node.first_block[i], row = node.child[i], count = node.last[i] - node.first[i];
    need(node.last_block[i] == block + 1 && tree_.place[block] == at * kLanes + i, "a block's place");
    need(tree_.block_objects[block] == culling::ObjectRun{node.first[i], node.last[i]}, "a block's objects");
    need(row % kPacket + count <= kPacket || row % kPacket == 0, "a block's packets");
    need(std::uint64_t{row} + culling::rows_of(count) <= kPacket * std::uint64_t{tree_.packets.size()},
         "a block's packets");
  }

  const BqrTree& tree_;
  std::vector<Ends> ends_;
};

void check_table(const Scene& scene, const LayerTable& table) {
  need(is_prefix(table.row_first, scene.tree.objects(), table.boxes.size()), "a layer's rows");
  for (std::size_t i = 1; i < table.row_first.size(); ++i)
    need(table.row_first[i] - table.row_first[i - 1] <= 1, "an object of two rows");
}

/// No vertex is of two objects: an object's indices lie together.
void check_rows(const Scene& scene, const MeshRows& layer, std::size_t rows) {
  need(is_prefix(layer.index_first, rows, layer.mesh.indices.size()), "a layer's indices");
  need(layer.mesh.indices.size() % 3 == 0, "a layer's triangles");
  need(std::ranges::all_of(layer.index_first, [](std::uint32_t i) { return i % 3 == 0; }), "an object's triangles");
  for_each_part(layer.mesh.indices, [&](auto part) { need(all_below(part, layer.mesh.vertices.size()), "an index"); });
  const auto bad = [&](const CityVertex& v) { return v.block >= scene.blocks.size(); };
  for_each_part(layer.mesh.vertices, [&](auto part) { need(std::ranges::none_of(part, bad), "a vertex's block"); });
  const StoredMesh& mesh = layer.mesh;
  need(mesh.textures.size() <= mesh.vertices.size(), "what vertices wear");
  const auto unknown = [&](std::uint32_t texture) { return texture > scene.pictures.textures.size(); };
  for_each_part(mesh.textures, [&](auto part) { need(std::ranges::none_of(part, unknown), "what a vertex wears"); });
}
void check_layer(const Scene& scene, const MeshLayer& layer) {
  check_table(scene, layer.table);
  check_rows(scene, layer, layer.table.size());
}

void check_trees(const Scene& scene) {
  check_table(scene, scene.trees.table);
  need(scene.trees.instances.size() == scene.trees.table.size(), "the trees");
  need(scene.trees.leeway.empty() || scene.trees.leeway.size() == scene.trees.table.size(), "the trees");
  for (const TreeInstance& t : scene.trees.instances) {
    need(t.block < scene.blocks.size() && t.plant < kPlantSpecies, "a tree's block or species");
    need(finite(Vec3d(t.position)) && std::isfinite(t.yaw), "a tree's place");
    need(t.height_m > 0 && t.height_m < 1e4F && t.crown_radius_m >= 0 && t.crown_radius_m < 1e4F, "a tree's size");
  }
}

void check_traffic(const Scene& scene) {
  const Traffic& t = scene.traffic;
  const auto run = [](std::uint32_t first, std::uint32_t last, std::size_t end) {
    return first <= last && last <= end;
  };
  need(is_prefix(t.block_first, scene.blocks.size(), t.block_halves.size()), "the half-streets of blocks");
  need(all_below(t.block_halves, t.halves.size()), "the half-streets of blocks");
  for (const HalfStreet& h : t.halves) {
    need(h.block < scene.blocks.size() && h.circuit < t.circuits.size(), "a half-street");
    need(run(h.first_point, h.last_point, t.points.size()) && h.last_point - h.first_point >= 2, "a lane");
    need(run(h.first_piece, h.last_piece, t.pieces.size()) && h.first_piece < h.last_piece, "a car's motion");
    need(std::isfinite(h.duration_s) && h.duration_s > 0, "a half-street's duration");
  }
  for (const Circuit& c : t.circuits) {
    need(run(c.first_half, c.last_half, t.halves.size()) && c.first_half < c.last_half, "a circuit");
    need(run(c.first_car, c.last_car, t.offsets.size()), "a circuit's cars");
    need(std::is_sorted(t.offsets.begin() + c.first_car, t.offsets.begin() + c.last_car), "a circuit's cars");
  }
}

void check_attributes(const Scene& scene) {
  const Attributes& a = scene.attributes;
  need(a.text.empty() || a.text.back() == '\0', "texts of attributes");
  for (const Attributes::Pair& pair : a.pairs)
    need(pair.name < a.text.size() && pair.value < a.text.size(), "an attribute");
  need(std::is_sorted(a.list_last.begin(), a.list_last.end()), "lists of attributes");
  need(a.list_last.empty() || (a.list_last.front() == 0 && a.list_last.back() == a.pairs.size()),
       "lists of attributes");
  for (const Attributes::Row& row : a.rows)
    need(row.list < a.list_last.size() && row.source < a.text.size(), "a row of attributes");
  need(a.row_of_object.empty() || a.row_of_object.size() == scene.tree.objects(), "attributes of objects");
  need(all_below(a.row_of_object, a.rows.size()), "attributes of objects");
}

void check_pictures(const Pictures& pictures) {
  for (const Texture& texture : pictures.textures)
    need(texture.picture < pictures.encoded.size() && texture.wrap < Wrap::count, "a texture");
  for (const EncodedPicture& picture : pictures.encoded)
    need(!picture.bytes.empty() && picture.worn.width > 0 && picture.worn.height > 0, "a picture");
}

void check_blocks(const Scene& scene) {
  need(scene.blocks.size() == scene.tree.blocks(), "the blocks");
  for (const BlockFrame& b : scene.blocks) {
    need(finite(b.origin), "a block's frame");
    for (int axis = 0; axis < 3; ++axis)
      need(finite(b.axes[axis]) && std::abs(glm::length(b.axes[axis]) - 1) < 1e-3, "a block's frame");
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  TreeCheck(scene.tree).run();
  check_blocks(scene);
  check_pictures(scene.pictures);
  check_layer(scene, scene.buildings);
  for (const MeshRows& level : scene.buildings.levels) check_rows(scene, level, scene.buildings.table.size());
  check_layer(scene, scene.surfaces);
  check_trees(scene);
  check_traffic(scene);
  check_attributes(scene);
  const bool empty = scene.bounds.empty();
  need(empty || (finite(scene.bounds.min) && finite(scene.bounds.max)), "the bounds");
}

}  // namespace manzana
