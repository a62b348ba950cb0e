#pragma once
/// Small scenes put together by hand, for pictures whose content is known.
///   HandBlock block; block.plan = {100, 0};
///   add_box(block.buildings, {0, 50, 0}, {20, 20, 60}, 0xff0000, Material::concrete);
///   Scene scene = make_scene({block});
#include <vector>

#include "culling/frustum.h"
#include "foliage/prepare.h"
#include "scenegraph/scene.h"
#include "scenegraph/visible.h"

namespace manzana {

/// A mesh in its block's frame; `block` of the vertices is filled in by make_scene.
struct HandMesh {
  std::vector<CityVertex> vertices;
  std::vector<std::uint32_t> indices;
};

struct HandBlock {
  Vec2d plan{0, 0};
  std::vector<HandMesh> buildings, surfaces;
  std::vector<TreeInstance> trees;
};

/// Corners counter-clockwise seen from outside.
void add_quad(HandMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::uint32_t rgb,
              Material material, const Vec2& uv_size = {0, 0});
/// A box on the ground: middle of its foot, size.
HandMesh make_box(const Vec3& foot, const Vec3& size, std::uint32_t rgb, Material material);
/// A level rectangle, facing up.
HandMesh make_level(const Vec3& middle, const Vec2& size, std::uint32_t rgb, Material material);

/// Blocks are stored in the tree's order; scene.blocks[i].origin tells which is which.
Scene make_scene(const std::vector<HandBlock>& blocks, const GeoPoint& anchor = {52, 13, 0});

/// A green double pyramid on a brown stick, for every kind.
std::vector<foliage::PreparedPlant> simple_plants();

/// Everything, or what the structure finds; cars are the caller's.
VisibleSets visible(const Scene& scene, const culling::View& view, Structure structure);

/// A camera in a block's frame: eye, and where it looks.
culling::View look_in(const BlockFrame& block, const Vec3d& eye, const Vec3d& forward, double fovy_deg, double aspect);

}  // namespace manzana
