#include "tests/scenegraph/horizon/rays.h"

#include <algorithm>

namespace manzana {
namespace {

/// From the eye to the point, both ends out.
bool crosses(const Vec3d& eye, const Vec3d& point, const Triangle& t) {
  const Vec3d d = point - eye, e1 = t[1] - t[0], e2 = t[2] - t[0], n = glm::cross(e1, e2);
  const double facing = -glm::dot(d, n);
  if (facing <= 0) return false;  // its back
  const Vec3d from = eye - t[0], q = glm::cross(from, d);
  const double at = glm::dot(from, n) / facing, u = glm::dot(e2, q) / facing, v = -glm::dot(e1, q) / facing;
  constexpr double kSeam = 1e-4;  // floats of two triangles that share an edge
  return at > 0 && at < 1 && u > -kSeam && v > -kSeam && u + v < 1 + kSeam;
}

std::vector<std::uint32_t> numbers(std::span<const culling::ObjectRun> runs) {
  std::vector<std::uint32_t> all;
  for (const culling::ObjectRun& run : runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) all.push_back(i);
  return all;
}

const culling::Box* box_of(const Scene& scene, std::uint32_t object) {
  for (const LayerTable* table : {&scene.trees.table, &scene.buildings.table, &scene.surfaces.table})
    if (table->row_first[object] < table->row_first[object + 1]) return &table->boxes[table->row_first[object]];
  return nullptr;
}

void check_hidden(const Scene& scene, const Vec3d& eye, const Triangles& triangles, std::uint32_t object,
                  support::Random& random) {
  const culling::Box* b = box_of(scene, object);
  REQUIRE(b != nullptr);
  for (int k = 0; k < 12; ++k) {
    const auto part = [&] { return k < 8 ? static_cast<double>(random.below(2)) : random.unit(); };
    const Vec3d at = glm::mix(Vec3d(b->min), Vec3d(b->max), Vec3d(part(), part(), part())) + scene.tree.origin;
    INFO("eye " << eye.x << " " << eye.y << " object " << object << " at " << at.x << " " << at.y << " " << at.z);
    REQUIRE(std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) { return crosses(eye, at, t); }));
  }
}

/// each(eye, sets, objects that were taken away).
template <class Each>
Taken take_away(const Scene& scene, std::span<const Vec3d> eyes, Each&& each) {
  VisibleSets sets(scene);
  Horizon horizon(scene);
  Taken taken;
  double turn = 0;
  for (const Vec3d& eye : eyes) {
    find_visible(scene, looking(eye, turn += 0.9), Structure::bqr, sets);
    const auto all = numbers(sets.objects());
    const std::size_t buildings = count(scene.buildings.table, sets.objects());
    horizon.hide(scene, {eye}, sets);
    const auto left = numbers(sets.objects());
    REQUIRE(std::includes(all.begin(), all.end(), left.begin(), left.end()));
    std::vector<std::uint32_t> gone;
    std::ranges::set_difference(all, left, std::back_inserter(gone));
    taken += {all.size(), gone.size(), buildings, buildings - count(scene.buildings.table, sets.objects())};
    each(eye, sets, gone);
  }
  return taken;
}

}  // namespace

Triangles triangles_of(const Scene& scene, std::span<const culling::ObjectRun> objects) {
  const MeshLayer& layer = scene.buildings;
  Triangles all;
  for (const culling::ObjectRun& run : objects) {
    const culling::ObjectRun rows = layer.table.rows(run);
    for (std::uint32_t i = layer.index_first[rows.first]; i < layer.index_first[rows.last]; i += 3) {
      Triangle t;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const CityVertex& v = layer.mesh.vertices[layer.mesh.indices[i + k]];
        t[k] = scene.blocks[v.block].to_local(Vec3d(v.position));
      }
      all.push_back(t);
    }
  }
  return all;
}

culling::View looking(const Vec3d& eye, double turn) {
  return culling::look(eye, {std::cos(turn), std::sin(turn), 0}, {0, 0, 1}, 1.05, 16.0 / 9);
}

Taken& Taken::operator+=(const Taken& other) {
  of += other.of, gone += other.gone, rays += other.rays;
  buildings += other.buildings, buildings_gone += other.buildings_gone;
  return *this;
}

Taken taken_away(const Scene& scene, std::span<const Vec3d> eyes) {
  return take_away(scene, eyes, [](auto&&...) {});
}

Taken check_by_rays(const Scene& scene, std::span<const Vec3d> eyes, support::Random& random) {
  std::size_t rays = 0;
  Taken taken = take_away(scene, eyes, [&](const Vec3d& eye, const VisibleSets& sets, const auto& gone) {
    const Triangles triangles = triangles_of(scene, sets.objects());
    for (const std::uint32_t object : gone) {
      if (random.below(static_cast<int>(gone.size())) >= 60) continue;
      check_hidden(scene, eye, triangles, object, random);
      rays += 12;
    }
  });
  taken.rays = rays;
  return taken;
}

}  // namespace manzana
