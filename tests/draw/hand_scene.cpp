#include "tests/draw/hand_scene.h"

#include <array>

namespace manzana {
namespace {

culling::BoxD box_of(const HandMesh& mesh, const BlockFrame& block) {
  culling::BoxD box;
  for (const CityVertex& v : mesh.vertices) box = merge(box, block.to_local(Vec3d(v.position)));
  return box;
}

culling::BoxD box_of(const TreeInstance& tree, const BlockFrame& block) {
  const double r = static_cast<double>(tree.crown_radius_m), h = static_cast<double>(tree.height_m);
  culling::BoxD box;
  for (const double z : {0.0, h}) {
    for (const double x : {-r, r}) {
      for (const double y : {-r, r}) box = merge(box, block.to_local(Vec3d(tree.position) + Vec3d(x, y, z)));
    }
  }
  return box;
}

void append(MeshLayer& layer, const HandMesh& mesh, std::uint32_t block) {
  const auto base = static_cast<std::uint32_t>(layer.mesh.vertices.size());
  for (CityVertex v : mesh.vertices) {
    v.block = block;
    layer.mesh.vertices.own().push_back(v);
  }
  for (const std::uint32_t i : mesh.indices) layer.mesh.indices.own().push_back(base + i);
  layer.index_first.push_back(static_cast<std::uint32_t>(layer.mesh.indices.size()));
}

/// An object's number is its place in `meshes` or, after all of those, in `trees`.
struct Loose {
  std::vector<const HandMesh*> meshes;
  std::vector<const TreeInstance*> trees;
  SceneObjects objects;
};

Loose gather(const std::vector<HandBlock>& blocks, const std::vector<BlockFrame>& frames) {
  Loose loose;
  const auto add = [&](std::uint32_t b, const std::vector<HandMesh>& meshes, ObjectClass kind) {
    for (const HandMesh& mesh : meshes) {
      loose.meshes.push_back(&mesh);
      loose.objects.add(b, box_of(mesh, frames[b]), kind);
    }
  };
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    add(b, blocks[b].buildings, kBuilding);
    add(b, blocks[b].surfaces, kSurface);
  }
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    for (const TreeInstance& tree : blocks[b].trees) {
      loose.trees.push_back(&tree);
      loose.objects.add(b, box_of(tree, frames[b]), kTree);
    }
  }
  return loose;
}

MeshLayer make_layer(const OrderedTree& built, const Loose& loose, std::span<const std::uint32_t> new_of_old,
                     ObjectClass kind) {
  MeshLayer layer;
  layer.table = make_table(built, loose.objects, kind);
  layer.index_first.push_back(0);
  for (const std::uint32_t i : numbers_of(built, kind))
    append(layer, *loose.meshes[i], new_of_old[loose.objects.blocks[i]]);
  return layer;
}

TreeLayer make_trees(const OrderedTree& built, const Loose& loose, std::span<const std::uint32_t> new_of_old) {
  TreeLayer layer;
  layer.table = make_table(built, loose.objects, kTree);
  for (const std::uint32_t i : numbers_of(built, kTree)) {
    layer.instances.push_back(*loose.trees[i - loose.meshes.size()]);
    layer.instances.back().block = new_of_old[loose.objects.blocks[i]];
  }
  return layer;
}

culling::BlockVolume volume_of(const HandBlock& block, const BlockFrame& frame) {
  culling::BlockVolume volume;
  volume.center = block.plan;
  volume.box = merge(volume.box, frame.origin);
  const auto add = [&](const culling::BoxD& box) {
    if (!box.empty()) volume.box = merge(volume.box, box);
  };
  for (const HandMesh& mesh : block.buildings) add(box_of(mesh, frame));
  for (const HandMesh& mesh : block.surfaces) add(box_of(mesh, frame));
  for (const TreeInstance& tree : block.trees) add(box_of(tree, frame));
  volume.sphere = enclosing_sphere(volume.box);
  return volume;
}

// A double pyramid of `sides`, a metre high.
void add_cone(foliage::MeshPart& part, int sides, float low, float high, float radius) {
  const float middle = 0.5F * (low + high);
  const auto vertex = [](const Vec3& p) {
    return foliage::MeshVertex{
        p, glm::normalize(Vec3(p.x, p.y, 0.5F * (p.z - 0.5F)) + Vec3(0, 0, 0.01F)), {0.5F, 0.5F}};
  };
  const auto base = static_cast<std::uint32_t>(part.vertices.size());
  part.vertices.push_back(vertex({0, 0, low}));
  part.vertices.push_back(vertex({0, 0, high}));
  for (int i = 0; i < sides; ++i) {
    const float a = 6.2831853F * static_cast<float>(i) / static_cast<float>(sides);
    part.vertices.push_back(vertex({radius * glm::cos(a), radius * glm::sin(a), middle}));
  }
  for (int i = 0; i < sides; ++i) {
    const std::uint32_t a = base + 2 + static_cast<std::uint32_t>(i),
                        b = base + 2 + static_cast<std::uint32_t>((i + 1) % sides);
    for (const std::uint32_t k : {base, b, a, base + 1, a, b}) part.indices.push_back(k);
  }
}

foliage::Image plain_image(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  foliage::Image image;
  image.size = 256;
  for (int i = 0; i < 256 * 256; ++i) image.rgba.insert(image.rgba.end(), {r, g, b, 255});
  return image;
}

}  // namespace

void add_quad(HandMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::uint32_t rgb,
              Material material, const Vec2& uv_size) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::uint32_t normal = pack_normal(glm::normalize(glm::cross(b - a, c - a)));
  const std::uint32_t colour = pack_colour(rgb, material);
  mesh.vertices.push_back({a, normal, colour, {0, 0}, 0});
  mesh.vertices.push_back({b, normal, colour, {uv_size.x, 0}, 0});
  mesh.vertices.push_back({c, normal, colour, uv_size, 0});
  mesh.vertices.push_back({d, normal, colour, {0, uv_size.y}, 0});
  for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + k);
}

HandMesh make_box(const Vec3& foot, const Vec3& size, std::uint32_t rgb, Material material) {
  const Vec3 low = foot - Vec3(size.x / 2, size.y / 2, 0), high = low + size;
  const std::array<Vec2, 4> corner{Vec2(low.x, low.y), Vec2(high.x, low.y), Vec2(high.x, high.y), Vec2(low.x, high.y)};
  HandMesh mesh;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = corner[i], b = corner[(i + 1) % 4];
    const Vec2 bays(glm::round(glm::distance(a, b) / 3), glm::round(size.z / 3));
    add_quad(mesh, {a.x, a.y, low.z}, {b.x, b.y, low.z}, {b.x, b.y, high.z}, {a.x, a.y, high.z}, rgb, material, bays);
  }
  const Material top = material == Material::wall ? Material::roof : material;
  add_quad(mesh, {low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, high.y, high.z}, {low.x, high.y, high.z},
           rgb, top, {size.x, size.y});
  return mesh;
}

HandMesh make_level(const Vec3& middle, const Vec2& size, std::uint32_t rgb, Material material) {
  const Vec3 x(size.x / 2, 0, 0), y(0, size.y / 2, 0);
  HandMesh mesh;
  add_quad(mesh, middle - x - y, middle + x - y, middle + x + y, middle - x + y, rgb, material, size);
  return mesh;
}

Scene make_scene(const std::vector<HandBlock>& blocks, const GeoPoint& anchor) {
  Scene scene;
  scene.frame = LocalFrame(anchor);
  std::vector<BlockFrame> frames;
  std::vector<culling::BlockVolume> volumes;
  for (const HandBlock& block : blocks) {
    frames.push_back(block_frame(scene.frame, block.plan));
    volumes.push_back(volume_of(block, frames.back()));
  }
  const Loose loose = gather(blocks, frames);
  OrderedTree built = build_tree(volumes, loose.objects);
  std::vector<std::uint32_t> new_of_old(blocks.size());
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    scene.blocks.push_back(frames[built.tree.order[b]]);
    new_of_old[built.tree.order[b]] = b;
  }
  scene.buildings = make_layer(built, loose, new_of_old, kBuilding);
  scene.surfaces = make_layer(built, loose, new_of_old, kSurface);
  scene.trees = make_trees(built, loose, new_of_old);
  scene.tree = std::move(built.tree);
  scene.traffic.halves.emplace_back();
  scene.traffic.block_first.assign(blocks.size() + 1, 0);
  for (const culling::BlockVolume& volume : volumes) {
    scene.bounds = merge(merge(scene.bounds, volume.box.min), volume.box.max);
  }
  return scene;
}

std::vector<foliage::PreparedPlant> simple_plants() {
  foliage::Plant plant;
  plant.name = "cone";
  add_cone(plant.mesh.bark, 12, 0.0F, 0.5F, 0.05F);
  add_cone(plant.mesh.leaves, 12, 0.2F, 1.0F, 1.0F);
  plant.centre_lines = {{{0, 0, 0}, 0.05F}, {{0, 0, 0.5F}, 0.0F}};
  plant.branches = {{.line = {0, 2}, .triangles = {0, 24}}};
  for (std::uint32_t i = 0; i < 24; ++i) plant.terminals.push_back({.triangles = {i, i + 1}});
  plant.leaf_image = plain_image(60, 130, 40);
  plant.bark_image = plain_image(110, 80, 50);
  return std::vector<foliage::PreparedPlant>(kPlantSpecies, prepare(plant));
}

VisibleSets visible(const Scene& scene, const culling::View& view, Structure structure) {
  VisibleSets sets(scene);
  find_visible(scene, view, structure, sets);
  return sets;
}

culling::View look_in(const BlockFrame& block, const Vec3d& eye, const Vec3d& forward, double fovy_deg, double aspect) {
  return culling::look(block.to_local(eye), block.axes * forward, block.axes[2], glm::radians(fovy_deg), aspect);
}

}  // namespace manzana
