#include "scenegraph/import/building_levels.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <map>
#include <numeric>

#include "scenegraph/import/edge_collapse.h"

namespace manzana {
namespace {

constexpr double kOneSurface = 0.9998;  // cosine between normals
constexpr float kSameUv = 0.02F;
constexpr float kSamePlace = 1.0F / 512;  // of a picture's side

using Corners = std::array<std::uint32_t, 3>;

Vec3d normal_of(const CityVertex& v) { return glm::normalize(Vec3d(glm::unpackSnorm3x10_1x2(v.normal))); }

/// Seen from the same side: the smallest first.
Corners turned_to_least(const Corners& c) {
  const std::size_t k = static_cast<std::size_t>(std::ranges::min_element(c) - c.begin());
  return {c[k], c[(k + 1) % 3], c[(k + 2) % 3]};
}

/// (u, v) as a linear function of the place.
struct Mapping {
  Vec3d u{0}, v{0};
  Vec2d at_origin{0};
  Vec2 operator()(const Vec3d& p) const { return Vec2(Vec2d(glm::dot(u, p), glm::dot(v, p)) + at_origin); }
};

class Levels {
 public:
  explicit Levels(const CityMesh& mesh) : mesh_(mesh) {
    weld();
    find_surfaces();
    paint();
  }

  std::array<CityMesh, kMeshLevels> run() {
    std::array<CityMesh, kMeshLevels> levels;
    EdgeCollapse collapse(points_, triangles_);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (!flat(t) || !straight(t))
        for (const std::uint32_t c : triangles_[t].corner) collapse.fix(c);
    std::size_t drawn = mesh_.indices.size();
    for (std::size_t l = 0; l < kMeshLevels; ++l) {
      collapse.run(kMeshLevelErrors[l]);
      CityMesh level = laid(collapse);
      if (static_cast<double>(level.indices.size()) > kLevelGain * static_cast<double>(drawn)) continue;
      drawn = level.indices.size();
      levels[l] = std::move(level);
    }
    return levels;
  }

 private:
  const CityVertex& vertex(std::size_t triangle, std::size_t k) const {
    return mesh_.vertices[mesh_.indices[3 * of_mesh_[triangle] + k]];
  }
  std::uint32_t texture(std::size_t t) const { return texture_of(mesh_, mesh_.indices[3 * of_mesh_[t] + 2]); }
  static bool close(const Vec2& a, const Vec2& b, float most) {
    return glm::all(glm::lessThan(glm::abs(a - b), Vec2(most)));
  }
  /// Its picture lies on it as it does on all of its surface.
  bool straight(std::uint32_t t) const {
    const auto lies = [&](std::size_t k) {
      return close(mappings_[surface_[t]](points_[triangles_[t].corner[k]]), vertex(t, k).uv, kSamePlace);
    };
    return texture(t) == 0 || (lies(0) && lies(1) && lies(2));
  }
  bool flat(std::size_t t) const {
    return vertex(t, 0).normal == vertex(t, 1).normal && vertex(t, 1).normal == vertex(t, 2).normal;
  }

  /// Vertices of one place are one point; a triangle and the same from behind are one.
  void weld() {
    std::map<std::array<float, 3>, std::uint32_t> at;
    std::map<Corners, std::uint32_t> seen;  // those that are taken, from their side
    for (std::uint32_t t = 0; t < mesh_.indices.size() / 3; ++t) {
      Corners corner{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = mesh_.vertices[mesh_.indices[3 * t + k]].position;
        const auto [found, fresh] = at.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(points_.size()));
        if (fresh) points_.emplace_back(p);
        corner[k] = found->second;
      }
      if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
      const auto behind = seen.find(turned_to_least({corner[0], corner[2], corner[1]}));
      if (behind != seen.end() && !both_sides_[behind->second]) {
        both_sides_[behind->second] = true;
        continue;
      }
      seen.try_emplace(turned_to_least(corner), static_cast<std::uint32_t>(triangles_.size()));
      triangles_.push_back({corner});
      of_mesh_.push_back(t);
      both_sides_.push_back(false);
    }
  }

  bool windows(std::size_t t) const {
    const Vec2 none(0);
    return static_cast<Material>(vertex(t, 2).colour >> 24) == Material::wall &&
           (vertex(t, 0).uv != none || vertex(t, 1).uv != none || vertex(t, 2).uv != none);
  }

  /// What is of one colour; but a wall with windows is for itself, so that they stay where they are, and so is what
  /// wears a picture, whatever the means of its parts are.
  void paint() {
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> paints;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const std::uint32_t worn = texture(t);
      const std::array own{worn, worn > 0 ? 0 : vertex(t, 2).colour, worn > 0 || windows(t) ? surface_[t] : 0};
      triangles_[t].paint = paints.try_emplace(own, static_cast<std::uint32_t>(paints.size())).first->second;
    }
  }

  double area(std::size_t t) const {
    const auto& c = triangles_[t].corner;
    return glm::length(glm::cross(points_[c[1]] - points_[c[0]], points_[c[2]] - points_[c[0]])) / 2;
  }

  /// Triangles that go on into each other, by their largest.
  void find_surfaces() {
    surface_.resize(triangles_.size());
    std::iota(surface_.begin(), surface_.end(), 0U);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edge;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(triangles_[t].corner[k], triangles_[t].corner[(k + 1) % 3]);
        const auto [at, fresh] = edge.try_emplace({a, b}, t);
        if (!fresh && go_on(at->second, t, a, b)) join(at->second, t);
      }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) surface_[t] = surface(t);
    mappings_.resize(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (surface_[t] == t) mappings_[t] = mapping(t);
  }
  std::uint32_t surface(std::uint32_t t) const {
    while (surface_[t] != t) t = surface_[t];
    return t;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = surface(a), b = surface(b);
    if (area(a) < area(b)) std::swap(a, b);
    surface_[b] = a;
  }
  Vec2 uv_at(std::uint32_t t, std::uint32_t point) const {
    const auto& corner = triangles_[t].corner;
    return vertex(t, static_cast<std::size_t>(std::ranges::find(corner, point) - corner.begin())).uv;
  }
  bool go_on(std::uint32_t s, std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t worn = texture(s);
    const auto same = [&](std::uint32_t point) {
      return close(uv_at(s, point), uv_at(t, point), worn > 0 ? kSamePlace : kSameUv);
    };
    if (worn != texture(t) || (worn == 0 && vertex(s, 2).colour != vertex(t, 2).colour)) return false;
    return same(a) && same(b) && glm::dot(normal_of(vertex(s, 2)), normal_of(vertex(t, 2))) > kOneSurface;
  }
  Mapping mapping(std::uint32_t t) const {
    const Vec3d p(vertex(t, 0).position), a = Vec3d(vertex(t, 1).position) - p, b = Vec3d(vertex(t, 2).position) - p;
    const Vec2d at(vertex(t, 0).uv), da = Vec2d(vertex(t, 1).uv) - at, db = Vec2d(vertex(t, 2).uv) - at;
    const Vec3d normal = glm::cross(a, b);
    const double size = glm::dot(normal, normal);
    if (!(size > 0)) return {Vec3d(0), Vec3d(0), at};
    const Vec3d of_a = glm::cross(b, normal) / size, of_b = glm::cross(normal, a) / size;
    Mapping m{of_a * da.x + of_b * db.x, of_a * da.y + of_b * db.y, {}};
    m.at_origin = at - Vec2d(glm::dot(m.u, p), glm::dot(m.v, p));
    return m;
  }

  CityMesh laid(const EdgeCollapse& collapse) const {
    CityMesh level;
    Shared shared;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!collapse.triangles()[t].alive) continue;
      const Corners& corner = collapse.triangles()[t].corner;
      lay(level, shared, t, corner, false);
      if (both_sides_[t]) lay(level, shared, t, corner, true);
    }
    return level;
  }

  using Shared =
      std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, float, float>, std::uint32_t>;
  void lay(CityMesh& level, Shared& shared, std::uint32_t t, const Corners& corner, bool behind) const {
    const Vec3d &a = points_[corner[0]], twice = glm::cross(points_[corner[1]] - a, points_[corner[2]] - a);
    const Vec3d own = normal_of(vertex(surface_[t], 2)), now = glm::normalize(twice);
    const Vec3d normal = glm::dot(own, now) > kOneSurface ? own : now;
    const bool kept = corner == triangles_[t].corner;  // then it is as it was, rounded or flat
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = behind ? 2 - i : i;
      CityVertex v = vertex(t, 2);
      v.position = Vec3(points_[corner[k]]);
      v.uv = kept ? vertex(t, k).uv : mappings_[surface_[t]](points_[corner[k]]);
      const Vec3d out = kept ? normal_of(vertex(t, k)) : normal;
      v.normal = pack_normal(Vec3(behind ? -out : out));
      const auto [at, fresh] = shared.try_emplace({corner[k], texture(t), v.normal, v.colour, v.uv.x, v.uv.y},
                                                  static_cast<std::uint32_t>(level.vertices.size()));
      if (fresh) level.vertices.push_back(v), wear(level, texture(t));
      level.indices.push_back(at->second);
    }
  }

  const CityMesh& mesh_;
  std::vector<Vec3d> points_;
  std::vector<EdgeCollapse::Triangle> triangles_;
  std::vector<std::uint32_t> of_mesh_;  // which of its triangles
  std::vector<bool> both_sides_;
  std::vector<std::uint32_t> surface_;  // which triangle speaks for it
  std::vector<Mapping> mappings_;       // of those that speak
};

}  // namespace

std::array<CityMesh, kMeshLevels> levels_of(const CityMesh& mesh) { return Levels(mesh).run(); }

}  // namespace manzana
