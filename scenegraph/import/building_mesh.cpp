#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scenegraph/import/laying.h"
#include "scenegraph/import/roof_mesh.h"

namespace manzana {
namespace {

constexpr double kLeastArea = 0.25;    // m2: what is smaller is not a building
constexpr double kLeastHeight = 0.05;  // metres
constexpr double kMostHeight = 2000;   // metres; taller than anything built

/// A face to be laid: all corners in one plane.
struct Paint {
  Vec3d normal{0, 0, 1};  // in the building's frame
  std::uint32_t colour = 0;
};

class Builder {
 public:
  Builder(CityMesh& mesh, const Laying& laying, const BuildingFeature& building)
      : mesh_(mesh), laying_(laying), building_(building) {}

  void body(const Geos& geos, Polygon footprint);

 private:
  void wall(const Vec2d& a, const Vec2d& b, const Roof& roof);
  void storeys(const Vec2d& a, const Vec2d& b, const Paint& paint);
  void facet(const RoofFacet& facet);
  void floor(const std::vector<plan::Triangle>& triangles);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  std::uint32_t corner(const Vec3d& p, const Paint& paint, const Vec2& uv) {
    const Vec3d normal = glm::normalize(laying_.normals * paint.normal);
    mesh_.vertices.push_back({Vec3(laying_.place(p)), pack_normal(Vec3(normal)), paint.colour, uv, 0});
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }
  void fan(std::uint32_t first, std::size_t corners) {
    for (std::uint32_t i = 2; i < corners; ++i) triangle(first, first + i - 1, first + i);
  }

  CityMesh& mesh_;
  const Laying& laying_;
  const BuildingFeature& building_;
  double eaves_ = 0;
  std::map<std::array<double, 4>, std::uint32_t> shared_;  // (x, y, slope) -> vertex: facets of a plane share corners
};

/// From the lowest floor to the eaves, with windows.
void Builder::storeys(const Vec2d& a, const Vec2d& b, const Paint& paint) {
  const double length = glm::distance(a, b), low = building_.min_height;
  if (eaves_ - low < 1e-3) return;
  const bool blind = length < kBlindWall;
  const float bays = blind ? 0.0F : static_cast<float>(std::max(1.0, std::round(length / kBay)));
  const float levels = blind ? 0.0F : static_cast<float>(std::max(1, building_.levels));
  const std::uint32_t first = corner({a, low}, paint, {0, 0});
  corner({b, low}, paint, {bays, 0});
  corner({b, eaves_}, paint, {bays, levels});
  corner({a, eaves_}, paint, {0, levels});
  fan(first, 4);
}

/// The wall on the edge from a to b, the inside on its left; above the eaves it is blind.
void Builder::wall(const Vec2d& a, const Vec2d& b, const Roof& roof) {
  const Vec2d out = -glm::normalize(plan::left_of(b - a));
  const Paint paint{{out, 0}, pack_colour(building_.wall_rgb, Material::wall)};
  storeys(a, b, paint);
  std::vector<Vec3d> ring = wall_top(roof, a, b);  // from a to b
  std::reverse(ring.begin(), ring.end());
  if (std::all_of(ring.begin(), ring.end(), [](const Vec3d& p) { return p.z < 1e-4; })) return;
  if (ring.front().z > 0) ring.insert(ring.begin(), Vec3d(b, 0));
  if (ring.back().z > 0) ring.emplace_back(a, 0);
  std::rotate(ring.begin(), ring.end() - 1, ring.end());  // a fan from a's eaves
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (const Vec3d& p : ring) corner(p + Vec3d(0, 0, eaves_), paint, {0, 0});
  fan(first, ring.size());
}

void Builder::facet(const RoofFacet& facet) {
  const Vec2d& slope = facet.plane.slope;
  const double steepness = glm::length(slope);
  const Vec2d up = steepness > 1e-9 ? slope / steepness : Vec2d{0, 1};
  const Vec2d along{up.y, -up.x};
  const double stretch = std::sqrt(1 + steepness * steepness);
  const Paint paint{{-slope, 1}, pack_colour(building_.roof_rgb, Material::roof)};
  std::vector<std::uint32_t> rows;
  for (const Vec3d& p : facet.corners) {
    const auto [at, fresh] = shared_.try_emplace({p.x, p.y, slope.x, slope.y}, 0);
    const Vec2 uv(glm::dot(Vec2d(p), along), glm::dot(Vec2d(p), up) * stretch);
    if (fresh) at->second = corner(p + Vec3d(0, 0, eaves_), paint, uv);
    rows.push_back(at->second);
  }
  for (std::size_t i = 2; i < rows.size(); ++i) triangle(rows[0], rows[i - 1], rows[i]);
}

void Builder::floor(const std::vector<plan::Triangle>& triangles) {
  const Paint paint{{0, 0, -1}, pack_colour(building_.wall_rgb, Material::wall)};
  shared_.clear();
  const auto row = [&](const Vec2d& p) {
    const auto [at, fresh] = shared_.try_emplace({p.x, p.y, 0, 0}, 0);
    if (fresh) at->second = corner({p, building_.min_height}, paint, {0, 0});
    return at->second;
  };
  for (const plan::Triangle& t : triangles) triangle(row(t[0]), row(t[2]), row(t[1]));
}

void Builder::body(const Geos& geos, Polygon footprint) {
  plan::wind(footprint);
  const std::vector<plan::Triangle> triangles = plan::triangulate(geos, footprint);
  if (triangles.empty()) return;
  const RoofShape shape = roof_that_fits(building_.roof, footprint);
  const double body = building_.height - building_.min_height;
  const double given = std::min(building_.roof_height, body);
  const double height = given > 0 ? given : default_roof_height(shape, footprint, body);
  const Roof roof = make_roof(shape, footprint, triangles, height);
  eaves_ = shape == RoofShape::flat ? building_.height : building_.height - height;
  const auto walls = [&](const plan::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) wall(ring[i], ring[(i + 1) % ring.size()], roof);
  };
  walls(footprint.outer);
  for (const plan::Ring& hole : footprint.holes) walls(hole);
  shared_.clear();
  for (const RoofFacet& f : roof.facets) facet(f);
  if (building_.min_height > 0) floor(triangles);
}

const char* fault(const BuildingFeature& b) {
  const bool rings_finite =
      plan::finite(b.footprint.outer) && std::all_of(b.footprint.holes.begin(), b.footprint.holes.end(),
                                                     [](const plan::Ring& hole) { return plan::finite(hole); });
  if (!rings_finite || !std::isfinite(b.height) || !std::isfinite(b.min_height) || !std::isfinite(b.roof_height))
    return "a coordinate or height is not finite";
  if (b.footprint.outer.size() < 3) return "an outline of fewer than three points";
  if (b.height - b.min_height < kLeastHeight) return "no height";
  if (b.height > kMostHeight || b.min_height < -kMostHeight) return "taller than 2 km";
  return nullptr;
}

/// Relative to `origin`, on the grid, without needless points.
plan::Ring tidied(const plan::Ring& ring, const Vec2d& origin) {
  plan::Ring result = ring;
  for (Vec2d& p : result) p = snapped(p - origin);
  return plan::simplified(result);
}

Polygon tidied(const Polygon& shape, const Vec2d& origin) {
  Polygon result{tidied(shape.outer, origin), {}};
  for (const plan::Ring& hole : shape.holes)
    if (plan::Ring ring = tidied(hole, origin); std::abs(plan::area(ring)) >= kLeastArea)
      result.holes.push_back(std::move(ring));
  return result;
}

}  // namespace

void append_building(CityMesh& mesh, const Site& site, const BuildingFeature& building, std::vector<Issue>& issues) {
  if (const char* what = fault(building)) return issues.push_back({building.where, what});
  const Geos geos;
  const Laying laying(site, building.footprint.outer[0], lowest_ground(site, building.footprint.outer));
  bool mended = false;
  const std::vector<Polygon> parts = geos.valid_polygons(tidied(building.footprint, laying.origin), mended);
  const std::size_t before = mesh.indices.size();
  Builder builder(mesh, laying, building);
  for (const Polygon& part : parts)
    if (Polygon tidy = tidied(part, {0, 0}); plan::area(tidy) >= kLeastArea) builder.body(geos, std::move(tidy));
  if (mesh.indices.size() == before) return issues.push_back({building.where, "an outline without area"});
  if (mended) issues.push_back({building.where, "the outline crosses itself; mended"});
}

}  // namespace manzana
