#include "foliage/leaf_quads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace manzana::foliage {
namespace {

/// All that a corner of a quad carries.
struct PackedCorner {
  PlantQuad::Corner corner;
  std::uint32_t normal;
  std::uint8_t shade;

  bool operator==(const PackedCorner& o) const {
    return corner.position == o.corner.position && corner.u == o.corner.u && corner.v == o.corner.v &&
           normal == o.normal && shade == o.shade;
  }
};

using Triangle = std::array<PackedCorner, 3>;

PackedCorner packed(const MeshVertex& v, std::uint32_t level) {
  return {{v.position, pack_uv(v.uv.x), pack_uv(v.uv.y)},
          pack_normal(v.normal) | (level << 30),
          static_cast<std::uint8_t>(std::lround(std::clamp(v.shade, 0.0F, 1.0F) * 255))};
}

PlantQuad quad_of(const std::array<PackedCorner, 4>& corners, const Vec3& anchor) {
  PlantQuad quad{};
  for (std::size_t k = 0; k < 4; ++k) {
    quad.corners[k] = corners[k].corner;
    quad.normals[k] = corners[k].normal;
    quad.shades[k] = corners[k].shade;
  }
  quad.anchor = anchor;
  return quad;
}

/// Edge 2-0 of `a` turned so that it is an edge of `b`, which winds alike.
std::optional<std::array<PackedCorner, 4>> joined(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (a[(i + 2) % 3] == b[(j + 1) % 3] && a[i] == b[j])
        return std::array{a[i], a[(i + 1) % 3], a[(i + 2) % 3], b[(j + 2) % 3]};
  return std::nullopt;
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

  Vec3 find() const {
    return terminal_.branch < 0 ? foot_of_picture() : nearest_to(plant_.branches[branch()].line);
  }

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

std::vector<Triangle> triangles_of(const Plant& plant, const Terminal& terminal) {
  const MeshPart& part = plant.mesh.leaves;
  const std::uint32_t level =
      terminal.branch < 0 ? 3 : std::min<std::uint32_t>(plant.branches[static_cast<std::size_t>(terminal.branch)].level, 3);
  std::vector<Triangle> triangles;
  for (std::size_t i = 3 * std::size_t{terminal.triangles.first}; i < 3 * std::size_t{terminal.triangles.last}; i += 3)
    triangles.push_back({packed(part.vertices[part.indices[i]], level), packed(part.vertices[part.indices[i + 1]], level),
                         packed(part.vertices[part.indices[i + 2]], level)});
  return triangles;
}

/// Each triangle takes the first later one that fits. Partners lie near each other in every file met.
void append_quads(const std::vector<Triangle>& triangles, const Vec3& anchor, std::vector<PlantQuad>& quads) {
  constexpr std::size_t kWindow = 16;
  std::vector<bool> taken(triangles.size(), false);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (taken[i]) continue;
    std::array<PackedCorner, 4> corners{triangles[i][0], triangles[i][1], triangles[i][2], triangles[i][2]};
    for (std::size_t j = i + 1; j < std::min(triangles.size(), i + kWindow); ++j) {
      if (taken[j]) continue;
      if (const auto both = joined(triangles[i], triangles[j])) {
        corners = *both;
        taken[j] = true;
        break;
      }
    }
    quads.push_back(quad_of(corners, anchor));
  }
}

}  // namespace

LeafQuads leaf_quads(const Plant& plant) {
  LeafQuads out;
  for (const Terminal& terminal : plant.terminals) {
    const auto first = static_cast<std::uint32_t>(out.quads.size());
    append_quads(triangles_of(plant, terminal), Petiole(plant, terminal).find(), out.quads);
    out.leaves.push_back({first, static_cast<std::uint32_t>(out.quads.size())});
  }
  return out;
}

}  // namespace manzana::foliage
