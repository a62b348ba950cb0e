// Each face is projected on its own plane, triangulated there, and lifted again by its corners; so edges that two faces
// share stay shared, and what was watertight stays so. Where an outline crosses itself the mended one has new corners:
// those are put on the plane.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "scenegraph/import/laying.h"
#include "scenegraph/import/plan_geometry.h"

namespace manzana {
namespace {

constexpr double kLeastFace = 1e-6;     // m2
constexpr double kUpright = 0.1;        // |z| of a wall's normal, at most
constexpr double kStorey = 3.0;         // metres, more or less
constexpr double kRectangular = 0.85;   // of its rectangle a wall fills, if it has windows
constexpr double kFarthestPoint = 1e5;  // metres from a construction's first point

struct FaceTriangle {
  std::array<Vec3d, 3> p;
  std::array<std::uint32_t, 3> corner;  // of the construction; kNew: made by mending
};
constexpr std::uint32_t kNew = UINT32_MAX;

/// A plane with axes; `origin` on it.
struct Plane {
  Vec3d origin{0, 0, 0}, normal{0, 0, 1}, u{1, 0, 0}, v{0, 1, 0};
  Vec2d flat(const Vec3d& p) const { return {glm::dot(p - origin, u), glm::dot(p - origin, v)}; }
  Vec3d lifted(const Vec2d& p) const { return origin + u * p.x + v * p.y; }
};

using Ring = std::span<const std::uint32_t>;

/// Twice the area, along the normal.  [Newell's method]
Vec3d newell(std::span<const Vec3d> points, Ring ring) {
  Vec3d sum(0);
  const Vec3d& o = points[ring[0]];
  for (std::size_t i = 2; i < ring.size(); ++i) sum += glm::cross(points[ring[i - 1]] - o, points[ring[i]] - o);
  return sum;
}

std::optional<Plane> plane_of(std::span<const Vec3d> points, Ring ring) {
  if (ring.size() < 3) return {};
  const Vec3d twice = newell(points, ring);
  const double size = glm::length(twice);
  if (!(size > 2 * kLeastFace)) return {};
  Plane plane{points[ring[0]], twice / size};
  const Vec3d aside = std::abs(plane.normal.z) < 0.9 ? Vec3d(0, 0, 1) : Vec3d(1, 0, 0);
  plane.u = glm::normalize(glm::cross(aside, plane.normal));
  plane.v = glm::cross(plane.normal, plane.u);
  return plane;
}

double area(const std::vector<plan::Triangle>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += plan::turn(a, b, c) / 2;
  return sum;
}

/// What a wall's windows are laid out by: all walls of a building in one plane.
struct WallExtent {
  Vec2d low{1e300, 1e300}, high{-1e300, -1e300};  // along, up
  double area = 0;
};

class Builder {
 public:
  Builder(CityMesh& mesh, const Site& site, const ConstructionFeature& work)
      : mesh_(mesh), work_(work), laying_(site, Vec2d(work.points[0]), lowest_ground(site, work.points)) {
    for (const Vec3d& p : work.points) points_.push_back(p - Vec3d(laying_.origin, 0));
  }

  void run(std::vector<Issue>& issues) {
    std::uint32_t face = 0;
    for (const std::uint32_t last : work_.part_last) {
      for (parts_.emplace_back(); face < last; ++face) cut(face);
    }
    measure_walls();
    for (const Part& part : parts_) lay(part);
    const auto tell = [&](std::size_t count, const char* what) {
      if (count > 0) issues.push_back({work_.where, std::to_string(count) + what});
    };
    tell(empty_, " faces without area");
    tell(mended_, " faces cross themselves; mended");
    tell(lost_, " faces could not be triangulated");
  }

 private:
  struct CutFace {
    std::uint32_t face = 0;
    Plane plane;
    std::vector<FaceTriangle> triangles;
    std::uint32_t texture = 0;
  };
  using Part = std::vector<CutFace>;

  Ring ring(std::uint32_t r) const {
    const std::uint32_t first = r == 0 ? 0 : work_.ring_last[r - 1];
    return std::span(work_.corners).subspan(first, work_.ring_last[r] - first);
  }

  std::uint32_t point(std::uint32_t corner) const { return work_.corners[corner]; }

  void cut(std::uint32_t face) {
    const std::uint32_t first = face == 0 ? 0 : work_.faces[face - 1].last_ring, last = work_.faces[face].last_ring;
    const auto plane = first < last ? plane_of(points_, ring(first)) : std::nullopt;
    if (!plane) return void(++empty_);
    Polygon shape;
    corner_at_.clear();
    for (std::uint32_t r = first; r < last; ++r) {
      std::vector<Vec2d>& flat = r == first ? shape.outer : shape.holes.emplace_back();
      for (const std::uint32_t& c : ring(r)) {
        flat.push_back(plane->flat(points_[c]));
        corner_at_.try_emplace({flat.back().x, flat.back().y}, static_cast<std::uint32_t>(&c - work_.corners.data()));
      }
    }
    CutFace done{face, *plane, {}, work_.faces[face].texture};
    for (const plan::Triangle& t : triangulated(shape)) done.triangles.push_back(lifted(*plane, t));
    for (const FaceTriangle& t : done.triangles)  // where it was mended nobody knows the picture's place
      if (std::ranges::find(t.corner, kNew) != t.corner.end()) done.texture = 0;
    if (!done.triangles.empty()) parts_.back().push_back(std::move(done));
  }

  std::vector<plan::Triangle> triangulated(const Polygon& shape) {
    const double whole = plan::area(shape);
    const auto covers = [&](double part) { return std::abs(part - whole) <= 1e-6 * whole + kLeastFace; };
    std::vector<plan::Triangle> triangles = plan::triangulate(geos_, shape);
    if (!triangles.empty() && covers(area(triangles))) return triangles;
    triangles.clear();
    bool mended = false;
    for (const Polygon& part : geos_.valid_polygons(shape, mended))
      for (const plan::Triangle& t : plan::triangulate(geos_, part)) triangles.push_back(t);
    ++(triangles.empty() ? lost_ : mended_);
    return triangles;
  }

  FaceTriangle lifted(const Plane& plane, const plan::Triangle& t) const {
    FaceTriangle result{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = corner_at_.find({t[k].x, t[k].y});
      result.corner[k] = at == corner_at_.end() ? kNew : at->second;
      result.p[k] = at == corner_at_.end() ? plane.lifted(t[k]) : points_[point(at->second)];
    }
    return result;
  }

  /// A wall that may have windows: its plane, to a degree and to 10 cm.
  static std::array<long, 3> wall_key(const Plane& plane) {
    const Vec2d out = glm::normalize(Vec2d(plane.normal));
    const double angle = std::atan2(out.y, out.x) * 57.29577951308232;
    return {std::lround(angle), std::lround(10 * glm::dot(Vec2d(plane.origin), out)), 0};
  }
  bool upright_wall(const CutFace& cut) const {
    return work_.faces[cut.face].kind == Material::wall && std::abs(cut.plane.normal.z) < kUpright;
  }
  static Vec2d on_wall(const CutFace& cut, const Vec3d& p) {
    return {glm::dot(Vec2d(p), plan::left_of(glm::normalize(Vec2d(cut.plane.normal)))), p.z};
  }

  void measure_walls() {
    for (const Part& part : parts_)
      for (const CutFace& cut : part) {
        if (!upright_wall(cut)) continue;
        WallExtent& wall = walls_[wall_key(cut.plane)];
        for (const FaceTriangle& t : cut.triangles) {
          for (const Vec3d& p : t.p)
            wall.low = glm::min(wall.low, on_wall(cut, p)), wall.high = glm::max(wall.high, on_wall(cut, p));
          wall.area += glm::length(glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0])) / 2;
        }
      }
  }

  Vec2 wall_uv(const CutFace& cut, const Vec3d& p) const {
    if (!upright_wall(cut)) return {0, 0};
    const WallExtent& wall = walls_.at(wall_key(cut.plane));
    const Vec2d size = wall.high - wall.low;
    if (size.x < kBlindWall || size.y < 0.7 * kStorey || wall.area < kRectangular * size.x * size.y) return {0, 0};
    const Vec2d bays{std::max(1.0, std::round(size.x / kBay)), std::max(1.0, std::round(size.y / kStorey))};
    const double below = std::max(0.0, std::round(wall.low.y / kStorey));  // shops are at the street only
    return Vec2((on_wall(cut, p) - wall.low) / size * bays + Vec2d(0, below));
  }

  Vec2 uv(const CutFace& cut, const Vec3d& p) const {
    const Material kind = work_.faces[cut.face].kind;
    if (kind == Material::wall) return wall_uv(cut, p);
    const Vec2d across(cut.plane.normal);
    const double steep = glm::length(across);
    const Vec3d along = steep > 1e-6 ? Vec3d(plan::left_of(across) / steep, 0) : Vec3d(1, 0, 0);
    return {static_cast<float>(glm::dot(p, along)),
            static_cast<float>(glm::dot(p, glm::cross(cut.plane.normal, along)))};
  }

  /// > 0: closed, normals outward; < 0: closed, inward; 0: open.
  double closed_volume(const Part& part) const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    double six = 0;
    for (const CutFace& cut : part)
      for (const FaceTriangle& t : cut.triangles) {
        six += glm::dot(t.p[0], glm::cross(t.p[1], t.p[2]));
        for (std::size_t k = 0; k < 3; ++k) {
          if (t.corner[k] == kNew || t.corner[(k + 1) % 3] == kNew) return 0;
          const std::uint32_t a = point(t.corner[k]), b = point(t.corner[(k + 1) % 3]);
          a < b ? ++balance[{a, b}] : --balance[{b, a}];
        }
      }
    const bool closed = std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
    return closed ? six / 6 : 0;
  }

  void lay(const Part& part) {
    const double volume = closed_volume(part);
    for (const CutFace& cut : part) {
      if (volume >= 0) lay(cut, false);
      if (volume <= 0) lay(cut, true);
    }
  }

  /// Corners are shared within a face while its triangles keep to its plane.
  void lay(const CutFace& cut, bool turned) {
    const double side = turned ? -1 : 1;
    shared_.clear();
    for (const FaceTriangle& t : cut.triangles) {
      const Vec3d twice = glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
      const double size = glm::length(twice);
      if (!(size > 0)) continue;
      const bool flat = glm::dot(twice, cut.plane.normal) > 0.9998 * size;
      if (!flat) shared_.clear();
      std::array<std::uint32_t, 3> rows{};
      for (std::size_t k = 0; k < 3; ++k) rows[k] = vertex(cut, t, k, side * (flat ? cut.plane.normal : twice / size));
      if (turned) std::swap(rows[1], rows[2]);
      mesh_.indices.insert(mesh_.indices.end(), rows.begin(), rows.end());
      if (!flat) shared_.clear();
    }
  }

  std::uint32_t vertex(const CutFace& cut, const FaceTriangle& t, std::size_t k, const Vec3d& normal) {
    const Vec3d& p = t.p[k];
    const auto [at, fresh] = shared_.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (!fresh) return at->second;
    const ConstructionFeature::Face& face = work_.faces[cut.face];
    const Vec3 laid(glm::normalize(laying_.normals * normal));
    const Vec2 place = cut.texture > 0 ? work_.uv[t.corner[k]] : uv(cut, p);
    mesh_.vertices.push_back({Vec3(laying_.place(p)), pack_normal(laid), pack_colour(face.rgb, face.kind), place, 0});
    wear(mesh_, cut.texture);
    return at->second;
  }

  CityMesh& mesh_;
  const ConstructionFeature& work_;
  const Laying laying_;
  const Geos geos_;
  std::vector<Vec3d> points_;  // in the laying's frame
  std::vector<Part> parts_;
  std::map<std::array<double, 2>, std::uint32_t> corner_at_;  // of the face being cut
  std::map<std::array<long, 3>, WallExtent> walls_;
  std::map<std::array<double, 3>, std::uint32_t> shared_;  // of the face being laid
  std::size_t empty_ = 0, mended_ = 0, lost_ = 0;
};

const char* fault(const ConstructionFeature& work) {
  if (work.points.empty() || work.faces.empty()) return "no surfaces";
  const auto near = [&](const Vec3d& p) {
    return glm::all(glm::lessThan(glm::abs(p - work.points[0]), Vec3d(kFarthestPoint)));
  };
  return std::ranges::all_of(work.points, near) ? nullptr : "a coordinate is not finite, or farther than 100 km";
}

}  // namespace

void append_construction(CityMesh& mesh, const Site& site, const ConstructionFeature& work,
                         std::vector<Issue>& issues) {
  if (const char* what = fault(work)) return issues.push_back({work.where, what});
  const std::size_t before = mesh.indices.size();
  Builder(mesh, site, work).run(issues);
  if (mesh.indices.size() == before) issues.push_back({work.where, "no surface that can be drawn"});
}

}  // namespace manzana
