#include "foliage/tube.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

constexpr float kPi = 3.14159265F;
constexpr float kBarkTile = 1.2F;  // metres of a stem that one bark image covers

MeshVertex ring_vertex(const StemPoint& at, int side, int sides, const Vec2& uv) {
  const float angle = 2 * kPi * static_cast<float>(side) / static_cast<float>(sides);
  const Vec3 out = at.frame[0] * std::cos(angle) + at.frame[1] * std::sin(angle);
  return {at.position + out * at.radius, out, uv};
}

}  // namespace

void add_tube(MeshPart& bark, std::span<const StemPoint> points, float length, int sides, float bark_repeats) {
  const auto first = static_cast<std::uint32_t>(bark.vertices.size());
  const auto row = static_cast<std::uint32_t>(sides + 1);
  const auto rings = static_cast<std::uint32_t>(points.size() - 1);
  const float v_end = std::min(length / kBarkTile, kUvRange);
  const auto v_at = [&](std::uint32_t ring) { return v_end * static_cast<float>(ring) / static_cast<float>(rings); };
  for (std::uint32_t r = 0; r < rings; ++r)
    for (int s = 0; s <= sides; ++s)
      bark.vertices.push_back(ring_vertex(points[r], s, sides,
                                          {bark_repeats * static_cast<float>(s) / static_cast<float>(sides), v_at(r)}));
  const StemPoint& tip = points.back();
  bark.vertices.push_back({tip.position, tip.frame[2], {0.5F * bark_repeats, v_end}});
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t s = 0; s + 1 < row; ++s) {
      const std::uint32_t a = first + r * row + s, b = a + 1, up = r + 1 == rings ? first + rings * row : a + row;
      bark.indices.insert(bark.indices.end(), {a, b, up});
      if (r + 1 < rings) bark.indices.insert(bark.indices.end(), {b, b + row, up});
    }
  }
}

void add_branch(Plant& plant, const Stem& stem, std::span<const StemPoint> points) {
  const auto line_size = [&] { return static_cast<std::uint32_t>(plant.centre_lines.size()); };
  const auto triangles = [&] { return static_cast<std::uint32_t>(plant.mesh.bark.triangles()); };
  Branch branch{stem.parent, static_cast<std::uint16_t>(stem.level), {line_size(), 0}, {triangles(), 0}};
  for (const StemPoint& p : points) plant.centre_lines.push_back({p.position, p.radius});
  plant.centre_lines.back().radius = 0;  // the tube ends in a point
  add_tube(plant.mesh.bark, points, stem.length, stem_sides(stem.level), stem.level == 0 ? 2 : 1);
  branch.line.last = line_size();
  branch.triangles.last = triangles();
  plant.branches.push_back(branch);
}

}  // namespace manzana::foliage
