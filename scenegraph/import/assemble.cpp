// Objects give blocks their volumes, these the tree, and the tree the order that all is stored in.
#include <algorithm>

#include "scenegraph/import/loose_city.h"

namespace manzana {
namespace {

class Assembler {
 public:
  explicit Assembler(LooseCity city) : c_(std::move(city)) { scene_.frame = c_.frame; }

  Imported run() {
    count();
    const SceneObjects objects = gather();
    OrderedTree built = build_tree(block_volumes(), objects);
    store(built, objects);
    scene_.tree = std::move(built.tree);
    return {std::move(scene_), std::move(c_.issues), report_};
  }

 private:
  /// visit(block, object): in this order they are numbered.
  template <class Visit>
  void each(Visit&& visit) const {
    for (const MeshObject& object : c_.buildings) visit(object.block, object);
    for (const MeshObject& object : c_.surfaces) visit(object.block, object);
    for (const TreeObject& object : c_.trees) visit(object.instance.block, object);
  }

  void count() {
    std::vector<std::size_t> objects(c_.blocks.size(), 0);
    each([&](std::uint32_t block, const auto&) { ++objects[block], ++report_.objects; });
    report_.blocks = objects.size();
    if (objects.empty()) return;
    std::sort(objects.begin(), objects.end());
    report_.objects_median = objects[objects.size() / 2];
    report_.objects_largest = objects.back();
  }

  SceneObjects gather() const {
    SceneObjects objects;
    each([&](std::uint32_t block, const auto& object) { objects.add(block, object.box, object.kind); });
    return objects;
  }

  std::vector<culling::BlockVolume> block_volumes() const {
    std::vector<BlockContent> content(c_.blocks.size());
    each([&](std::uint32_t block, const auto& object) { content[block].add(object.box); });
    const Traffic& traffic = c_.traffic;
    for (std::uint32_t half = 0; half < traffic.halves.size(); ++half)
      content[traffic.halves[half].block].add(half_street_bounds(traffic, half));
    std::vector<culling::BlockVolume> volumes;
    volumes.reserve(content.size());
    for (std::size_t b = 0; b < content.size(); ++b)
      volumes.push_back(content[b].volume(Vec2d(c_.blocks[b].origin), c_.blocks[b].origin));
    for (const HalfStreet& half : traffic.halves) volumes[half.block].classes = kCar;
    return volumes;
  }

  void store(const OrderedTree& built, const SceneObjects& objects) {
    for (const culling::BoxD& box : objects.boxes) scene_.bounds = merge(scene_.bounds, box);
    store_blocks(built);
    store_attributes(built);
    const auto surfaces = static_cast<std::uint32_t>(c_.buildings.size()),
               trees = static_cast<std::uint32_t>(surfaces + c_.surfaces.size());
    const auto table = [&](culling::ClassMask kinds) { return make_table(built, objects, kinds); };
    scene_.buildings = make_layer(table(kBuildings), numbers_of(built, kBuildings), 0, std::move(c_.buildings));
    scene_.surfaces = make_layer(table(kSurface), numbers_of(built, kSurface), surfaces, std::move(c_.surfaces));
    scene_.trees = make_layer(table(kTrees), numbers_of(built, kTrees), trees, c_.trees);
    scene_.attribution = std::move(c_.attribution);
    scene_.pictures = std::move(c_.pictures);
  }

  void store_blocks(const OrderedTree& built) {
    std::vector<std::uint32_t> new_of_old(c_.blocks.size());
    for (std::uint32_t b = 0; b < c_.blocks.size(); ++b) {
      scene_.blocks.push_back(c_.blocks[built.tree.order[b]]);
      new_of_old[built.tree.order[b]] = b;
    }
    for (MeshObject& object : c_.buildings) object.block = new_of_old[object.block];
    for (MeshObject& object : c_.surfaces) object.block = new_of_old[object.block];
    for (TreeObject& object : c_.trees) object.instance.block = new_of_old[object.instance.block];
    scene_.traffic = std::move(c_.traffic);
    reorder_blocks(scene_.traffic, new_of_old);
  }

  void store_attributes(const OrderedTree& built) {
    if (c_.attributes.rows.empty()) return;
    std::vector<std::uint32_t> rows;
    each([&](std::uint32_t, const auto& object) { rows.push_back(object.attributes); });
    scene_.attributes = std::move(c_.attributes);
    for (const std::uint32_t number : built.numbers) scene_.attributes.row_of_object.push_back(rows[number]);
  }

  LooseCity c_;
  Scene scene_;
  ImportReport report_;
};

}  // namespace

Imported assemble(LooseCity city) { return Assembler(std::move(city)).run(); }

}  // namespace manzana
