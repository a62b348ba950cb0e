#include "apps/walkthrough/obstacles.h"

#include "apps/walkthrough/camera_path.h"

namespace manzana::walkthrough {
namespace {

constexpr double kBuildingCell = 32, kTreeCell = 8;  // metres

/// Whether the triangle lies straight above p. Half-open edges, so that a point over a shared edge counts once.
bool above(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto crossing = [&](const Vec3d& u, const Vec3d& v) {
    return (u.y > p.y) != (v.y > p.y) && p.x < u.x + (v.x - u.x) * (p.y - u.y) / (v.y - u.y);
  };
  if ((crossing(a, b) ^ crossing(b, c) ^ crossing(c, a)) == 0) return false;
  const Vec3d normal = glm::cross(b - a, c - a);
  return normal.z != 0 && a.z - ((p.x - a.x) * normal.x + (p.y - a.y) * normal.y) / normal.z > p.z;
}

double distance_to_segment(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const Vec2d along = b - a;
  const double length2 = glm::dot(along, along);
  const double s = length2 > 0 ? glm::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + along * s);
}

}  // namespace

Obstacles::Obstacles(const Scene& scene) : scene_(scene), buildings_(kBuildingCell), trees_(kTreeCell) {
  const LayerTable& t = scene.buildings.table;
  const Vec2d origin(scene.tree.origin);
  for (std::uint32_t i = 0; i < t.size(); ++i)
    buildings_.add(origin + Vec2d(t.boxes[i].min), origin + Vec2d(t.boxes[i].max), i);
  buildings_.finish();
  for (std::uint32_t i = 0; i < scene.trees.instances.size(); ++i) {
    const TreeInstance& tree = scene.trees.instances[i];
    const Vec2d foot(scene.blocks[tree.block].to_local(Vec3d(tree.position)));
    trees_.add(foot, foot, i);
  }
  trees_.finish();
}

bool Obstacles::covers(std::uint32_t building, const Vec3d& local) const {
  const MeshLayer& layer = scene_.buildings;
  const std::uint32_t first = layer.index_first[building], last = layer.index_first[building + 1];
  if (first == last) return false;
  const auto vertex = [&](std::uint32_t i) -> const CityVertex& { return layer.mesh.vertices[layer.mesh.indices[i]]; };
  const Vec3d p = scene_.blocks[vertex(first).block].to_block(local);
  bool inside = false;
  for (std::uint32_t i = first; i + 2 < last; i += 3)
    inside ^= above(p, Vec3d(vertex(i).position), Vec3d(vertex(i + 1).position), Vec3d(vertex(i + 2).position));
  return inside;
}

bool Obstacles::inside_building(const Vec3d& point) const {
  const Vec3d local = from_ground(scene_.frame, point);
  const Vec3d p = local - scene_.tree.origin;
  const LayerTable& t = scene_.buildings.table;
  bool inside = false;
  std::uint32_t last = ~0U;
  buildings_.visit(Vec2d(local), 0, [&](std::uint32_t i) {
    const culling::Box box = t.boxes[i];
    const auto in_box = [&] { return glm::clamp(p, Vec3d(box.min), Vec3d(box.max)) == p; };
    if (inside || i == last || !in_box()) return;
    last = i;
    inside = covers(i, local);
  });
  return inside;
}

bool Obstacles::trunk_near(const Vec2d& plan, double margin) const {
  bool near = false;
  trees_.visit(plan, margin, [&](std::uint32_t i) {
    const TreeInstance& tree = scene_.trees.instances[i];
    const Vec2d foot(scene_.blocks[tree.block].to_local(Vec3d(tree.position)));
    near = near || glm::distance(plan, foot) < margin;
  });
  return near;
}

bool Obstacles::clear(const Vec3d& point, double margin) const {
  if (trunk_near({point.x, point.y}, margin) || inside_building(point)) return false;
  for (int side = 0; side < 8; ++side) {
    const double angle = side * glm::radians(45.0);
    if (inside_building(point + Vec3d(std::cos(angle), std::sin(angle), 0) * margin)) return false;
  }
  return true;
}

double Obstacles::buried_length(const Vec3d& from, const Vec3d& to) const {
  constexpr double kStep = 3;  // metres: thinner buildings may be passed over
  const int steps = std::max(1, static_cast<int>(glm::distance(from, to) / kStep));
  int buried = 0;
  for (int i = 0; i <= steps; ++i)
    buried += inside_building(glm::mix(from, to, static_cast<double>(i) / steps)) ? 1 : 0;
  return glm::distance(from, to) * buried / (steps + 1);
}

double Obstacles::highest_roof(const Vec2d& a, const Vec2d& b, double radius) const {
  const double step = std::max(radius, kBuildingCell), length = glm::distance(a, b);
  double highest = 0;
  const auto see = [&](std::uint32_t i) {
    const culling::Box box = scene_.buildings.table.boxes[i];
    const Vec3d top = scene_.tree.origin + Vec3d(Vec2d(box.min + box.max) / 2.0, box.max.z);
    if (distance_to_segment(Vec2d(top), a, b) < radius) highest = std::max(highest, to_ground(scene_.frame, top).z);
  };
  for (double s = 0; s < length + step; s += step)
    buildings_.visit(length > 0 ? glm::mix(a, b, std::min(s / length, 1.0)) : a, radius + step / 2, see);
  return highest;
}

}  // namespace manzana::walkthrough
