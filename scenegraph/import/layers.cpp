#include "scenegraph/import/layers.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "foliage/wind.h"
#include "scenegraph/import/terrain.h"

namespace manzana {
namespace {

using culling::BoxD;

// A float scaled by (r, r, h) on the GPU may come out some units in the last place larger.
constexpr double kTreeSlack = 1 + 1e-5;

void append(MeshRows& rows, const CityMesh& mesh, std::uint32_t block) {
  const std::size_t base = rows.mesh.vertices.size();
  if (base + mesh.vertices.size() > std::numeric_limits<std::uint32_t>::max() ||
      rows.mesh.indices.size() + mesh.indices.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error("more than 2^32 vertices or indices in one layer");
  for (CityVertex v : mesh.vertices) {
    v.block = block;
    rows.mesh.vertices.own().push_back(v);
  }
  if (!mesh.textures.empty()) rows.mesh.textures.own().resize(base);
  std::ranges::copy(mesh.textures, std::back_inserter(rows.mesh.textures.own()));
  for (const std::uint32_t i : mesh.indices) rows.mesh.indices.own().push_back(static_cast<std::uint32_t>(base) + i);
  rows.index_first.push_back(static_cast<std::uint32_t>(rows.mesh.indices.size()));
}

void append(MeshLayer& layer, const MeshObject& object) {
  append(layer, object.mesh, object.block);
  for (std::size_t l = 0; l < kMeshLevels; ++l) append(layer.levels[l], object.levels[l], object.block);
}

}  // namespace

BoxD bounds(const CityMesh& mesh, const BlockFrame& frame) {
  BoxD box;
  for (const CityVertex& v : mesh.vertices) box = merge(box, frame.to_local(v.position));
  return box;
}

BoxD bounds(const TreeInstance& tree, const BlockFrame& frame) {
  const Vec3d foot = tree.position;
  const double h = static_cast<double>(tree.height_m) * kTreeSlack;
  const double r = static_cast<double>(tree.crown_radius_m) * kTreeSlack + h * foliage::kMostSway;
  BoxD box;
  for (const double x : {-r, r})
    for (const double y : {-r, r})
      for (const double z : {-1e-5 * h, h}) box = merge(box, frame.to_local(foot + Vec3d(x, y, z)));
  return box;
}

CityMesh lay(SurfacePiece piece, const Site& site) {
  if (site.terrain != nullptr) drape(piece.plan, piece.center, *site.terrain);
  for (CityVertex& v : piece.plan.vertices) {
    const Vec2d plan = piece.center + Vec2d(v.position.x, v.position.y);
    v.position = ground_point(site.frame, site.block, plan, static_cast<double>(v.position.z));
  }
  return std::move(piece.plan);
}

void BlockContent::add(const BoxD& box) {
  if (box.empty()) return;
  box_ = merge(box_, box);
  balls_.push_back(enclosing_sphere(box));
}

culling::BlockVolume BlockContent::volume(const Vec2d& center, const Vec3d& ground) const {
  if (box_.empty()) return {center, {ground, ground}, {ground, 0}};
  const culling::SphereD round_box = enclosing_sphere(box_), round_balls = culling::enclosing_sphere(balls_);
  return {center, box_, round_balls.radius < round_box.radius ? round_balls : round_box};
}

MeshLayer make_layer(LayerTable table, std::span<const std::uint32_t> numbers, std::uint32_t from,
                     std::vector<MeshObject> objects) {
  MeshLayer layer;
  layer.table = std::move(table);
  layer.index_first.push_back(0);
  for (MeshRows& level : layer.levels) level.index_first.push_back(0);
  for (const std::uint32_t number : numbers) {
    append(layer, objects[number - from]);
    objects[number - from].mesh = {}, objects[number - from].levels = {};
  }
  return layer;
}

TreeLayer make_layer(LayerTable table, std::span<const std::uint32_t> numbers, std::uint32_t from,
                     const std::vector<TreeObject>& objects) {
  TreeLayer layer;
  layer.table = std::move(table);
  for (const std::uint32_t number : numbers) layer.instances.push_back(objects[number - from].instance);
  return layer;
}

}  // namespace manzana
