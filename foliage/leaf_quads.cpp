#include "foliage/leaf_quads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "foliage/plant_quads.h"

namespace manzana::foliage {
namespace {

/// Indices with vertices that are alike made one: files repeat them.
std::vector<std::uint32_t> welded(const MeshPart& part) {
  const auto key = [&](std::uint32_t i) {
    const MeshVertex& v = part.vertices[i];
    return std::tuple(v.position.x, v.position.y, v.position.z, v.uv.x, v.uv.y, v.normal.x, v.normal.y, v.normal.z,
                      v.shade);
  };
  std::vector<std::uint32_t> order(part.vertices.size()), first(part.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  std::vector<std::uint32_t> indices;
  indices.reserve(part.indices.size());
  for (const std::uint32_t i : part.indices) indices.push_back(first[i]);
  return indices;
}

struct Edge {
  Vec3 a, b;
};

/// Parameters in [0, 1] of the points of two edges that are nearest to each other. [Ericson, Real-Time Collision
/// Detection, 2005, 5.1.9]
std::pair<float, float> nearest_parameters(const Edge& e, const Edge& f) {
  const Vec3 d1 = e.b - e.a, d2 = f.b - f.a, r = e.a - f.a;
  const float a = glm::dot(d1, d1), b = glm::dot(d1, d2), c = glm::dot(d1, r), g = glm::dot(d2, d2),
              h = glm::dot(d2, r);
  if (a <= 0) return {0.0F, g > 0 ? std::clamp(h / g, 0.0F, 1.0F) : 0.0F};
  if (g <= 0) return {std::clamp(-c / a, 0.0F, 1.0F), 0.0F};
  const float denominator = a * g - b * b;
  float s = denominator > 1e-6F * a * g ? std::clamp((b * h - c * g) / denominator, 0.0F, 1.0F) : 0.5F;
  const float t = std::clamp((b * s + h) / g, 0.0F, 1.0F);
  s = std::clamp((b * t - c) / a, 0.0F, 1.0F);
  return {s, t};
}

/// Finds the petiole among the edges of one leaf.
class Petiole {
 public:
  Petiole(const Plant& plant, const Terminal& terminal) : plant_(plant), terminal_(terminal) {}

  Vec3 find() const { return terminal_.branch < 0 ? foot_of_picture() : nearest_to(plant_.branches[branch()].line); }

 private:
  std::size_t branch() const { return static_cast<std::size_t>(terminal_.branch); }

  template <class Visit>  // void(const MeshVertex&, const MeshVertex&)
  void for_each_edge(Visit&& visit) const {
    const MeshPart& part = plant_.mesh.leaves;
    for (std::size_t i = 3 * std::size_t{terminal_.triangles.first}; i < 3 * std::size_t{terminal_.triangles.last}; ++i)
      visit(part.vertices[part.indices[i]], part.vertices[part.indices[i % 3 == 2 ? i - 2 : i + 1]]);
  }

  Vec3 foot_of_picture() const {
    float best = std::numeric_limits<float>::infinity();
    Vec3 foot(0);
    for_each_edge([&](const MeshVertex& a, const MeshVertex& b) {
      const float away = std::abs(a.uv.y - 1) + std::abs(b.uv.y - 1);
      if (away < best) best = away, foot = 0.5F * (a.position + b.position);
    });
    return foot;
  }

  Vec3 nearest_to(const Run& line) const {
    float best = std::numeric_limits<float>::infinity();
    Vec3 petiole(0);
    for_each_edge([&](const MeshVertex& a, const MeshVertex& b) {
      const Edge edge{a.position, b.position};
      for (std::size_t i = line.first; i + 1 < line.last; ++i) {
        const Edge piece{plant_.centre_lines[i].position, plant_.centre_lines[i + 1].position};
        const auto [s, t] = nearest_parameters(edge, piece);
        const Vec3 at = edge.a + (edge.b - edge.a) * s, gap = at - (piece.a + (piece.b - piece.a) * t);
        if (glm::dot(gap, gap) < best) best = glm::dot(gap, gap), petiole = at;
      }
    });
    return petiole;
  }

  const Plant& plant_;
  const Terminal& terminal_;
};

std::uint32_t level_of(const Plant& plant, const Terminal& terminal) {
  return terminal.branch < 0 ? 3 : plant.branches[static_cast<std::size_t>(terminal.branch)].level;
}

}  // namespace

LeafQuads leaf_quads(const Plant& plant) {
  LeafQuads out;
  const std::vector<std::uint32_t> indices = welded(plant.mesh.leaves);
  for (const Terminal& terminal : plant.terminals) {
    const auto first = static_cast<std::uint32_t>(out.quads.size());
    const auto own = std::span(indices).subspan(3 * std::size_t{terminal.triangles.first},
                                                3 * std::size_t{terminal.triangles.size()});
    add_quads(plant.mesh.leaves, own, {Petiole(plant, terminal).find(), level_of(plant, terminal)}, out.quads);
    out.leaves.push_back({first, static_cast<std::uint32_t>(out.quads.size())});
  }
  return out;
}

double quad_area(const PlantQuad& quad) {
  const auto corner = [&](std::size_t k) { return Vec3d(quad.corners[k].position); };
  const auto half = [&](std::size_t b, std::size_t c) {
    return 0.5 * glm::length(glm::cross(corner(b) - corner(0), corner(c) - corner(0)));
  };
  return half(1, 2) + half(2, 3);
}

}  // namespace manzana::foliage
