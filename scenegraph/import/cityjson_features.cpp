// The frame lies about the middle of everything. Then works are laid on its ground, and ground is flattened onto it.
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include "scenegraph/import/cityjson_objects.h"
#include "scenegraph/import/defaults.h"
#include "scenegraph/import/plan_geometry.h"
#include "scenegraph/import/terrain_heights.h"

namespace manzana::cityjson {
namespace {

constexpr double kReach = 300e3;       // metres from the middle; what lies farther is a stray
constexpr double kSliver = 0.5;        // m2: what joining leaves over beside larger pieces
constexpr double kLeastGround = 0.01;  // m2, in plan: smaller are upright

GeoPoint place_of(const Vec3d& geo) { return {geo.x, geo.y, 0}; }

LocalFrame frame_of(const Collected& all) {
  std::vector<GeoPoint> points;
  for (const Work& work : all.works)
    for (const Vec3d& p : work.shape.points) points.push_back(place_of(p));
  for (const StandingTree& tree : all.trees) points.push_back({tree.foot.lat_deg, tree.foot.lon_deg, 0});
  return LocalFrame(median_of(points));
}

/// Calls with each ring of each face: face, first ring of it, corners.
template <class Visit>
void each_ring(const ConstructionFeature& shape, Visit&& visit) {
  std::uint32_t ring = 0, corner = 0;
  for (std::uint32_t face = 0; face < shape.faces.size(); ++face)
    for (const std::uint32_t first = ring; ring < shape.faces[face].last_ring; corner = shape.ring_last[ring++])
      visit(face, ring == first, std::span(shape.corners).subspan(corner, shape.ring_last[ring] - corner));
}

/// Twice the area of each face's outer ring, along its normal.
std::vector<Vec3d> normals_of(const ConstructionFeature& shape) {
  std::vector<Vec3d> normals(shape.faces.size(), Vec3d(0));
  each_ring(shape, [&](std::uint32_t face, bool outer, std::span<const std::uint32_t> ring) {
    for (std::size_t i = 2; outer && i < ring.size(); ++i) {
      const Vec3d &o = shape.points[ring[0]], &a = shape.points[ring[i - 1]], &b = shape.points[ring[i]];
      normals[face] += glm::cross(a - o, b - o);
    }
  });
  return normals;
}

FaceKind by_slope(const Vec3d& normal) {
  const double z = normal.z / std::max(glm::length(normal), 1e-300);
  return std::abs(z) < 0.35 ? FaceKind::wall : z > 0 ? FaceKind::roof : FaceKind::floor;
}

class Laying {
 public:
  explicit Laying(Collected all) : all_(std::move(all)) {}

  CityFeatures run() {
    city_.frame = frame_of(all_);
    city_.attribution = std::move(all_.attribution);
    city_.attributes = std::move(all_.attributes);
    city_.pictures = std::move(all_.pictures);
    for (const Issue& issue : all_.issues) told_.insert(issue.where);
    for (Work& work : all_.works) lay(work);
    read_terrain();
    for (Work& work : all_.works) finish(work);
    for (const StandingTree& tree : all_.trees) plant(tree);
    if (city_.constructions.empty() && city_.areas.empty() && city_.trees.empty())
      all_.issues.push_back({"file", "holds nothing that can be drawn"});
    city_.issues = std::move(all_.issues);
    return std::move(city_);
  }

 private:
  std::optional<Vec2d> plan(const Vec3d& geo) const {
    const Vec3d p = city_.frame.to_local(place_of(geo));
    return glm::length(p) <= kReach ? std::optional(Vec2d(p)) : std::nullopt;
  }

  /// From (latitude, longitude, height) to (x, y, height); what does not fit is emptied.
  void lay(Work& work) {
    ConstructionFeature& shape = work.shape;
    for (Vec3d& p : shape.points) {
      const auto at = plan(p);
      if (!at) {
        shape.faces.clear();
        all_.issues.push_back({shape.where, "too far from the rest of the data"});
        told_.insert(shape.where);
        return;
      }
      p = {*at, p.z};
    }
    if (shape.faces.empty() && !told_.contains(shape.where))
      all_.issues.push_back({shape.where, "brings no surfaces above LoD 0"});
  }

  void read_terrain() {
    std::vector<TerrainHeights::Triangle> triangles;
    for (const Work& work : all_.works) {
      if (work.role != Role::terrain) continue;
      each_ring(work.shape, [&](std::uint32_t, bool outer, std::span<const std::uint32_t> ring) {
        const auto& p = work.shape.points;
        for (std::size_t i = 2; outer && i < ring.size(); ++i)
          triangles.push_back({p[ring[0]], p[ring[i - 1]], p[ring[i]]});
      });
    }
    terrain_ = TerrainHeights(std::move(triangles));
  }

  void finish(Work& work) {
    if (work.shape.faces.empty() || work.role == Role::terrain) return;
    if (work.role == Role::ground) return flatten(work);
    stand(work.shape);
    paint(work);
    city_.constructions.push_back(std::move(work.shape));
  }

  /// On the terrain below its middle; without one, on its own lowest point.
  void stand(ConstructionFeature& shape) const {
    Vec3d low = shape.points[0], high = low;
    for (const Vec3d& p : shape.points) low = glm::min(low, p), high = glm::max(high, p);
    const double ground = terrain_.at(Vec2d(low + (high - low) / 2.0)).value_or(low.z);
    for (Vec3d& p : shape.points) p.z -= ground;
  }

  static void paint(Work& work) {
    const std::vector<Vec3d> normals = normals_of(work.shape);
    double flat = 0, sloped = 0;
    std::vector<FaceKind> kinds = work.kinds;
    for (std::size_t f = 0; f < kinds.size(); ++f) {
      if (kinds[f] == FaceKind::untold || kinds[f] == FaceKind::paved) kinds[f] = by_slope(normals[f]);
      const double size = glm::length(normals[f]);
      if (kinds[f] == FaceKind::roof) (normals[f].z > 0.97 * size ? flat : sloped) += size;
    }
    const BuildingSite site{.kind = "yes", .id = work.id};
    const std::uint32_t wall = wall_colour_of(site);
    const std::uint32_t roof = roof_colour_of(site, flat >= sloped ? RoofShape::flat : RoofShape::gabled);
    const bool building = work.role == Role::building;
    for (std::size_t f = 0; f < kinds.size(); ++f) {
      ConstructionFeature::Face& face = work.shape.faces[f];
      const bool opening = kinds[f] == FaceKind::window || kinds[f] == FaceKind::door;
      if (building && !opening) face.kind = kinds[f] == FaceKind::roof ? Material::roof : Material::wall;
      if (building) face.rgb = kinds[f] == FaceKind::roof ? roof : wall;
      if (kinds[f] == FaceKind::window) face.rgb = 0x4f5d68;
      if (kinds[f] == FaceKind::door) face.rgb = 0x6b5138;
      if (work.colour[f] != kNone) face.rgb = work.colour[f];
    }
  }

  /// The faces of a kind, seen from above, as one.
  void flatten(const Work& work) {
    std::map<Material, std::vector<Geometry>> pieces;
    Polygon face;
    const auto flush = [&](std::uint32_t f) {
      if (face.outer.size() < 3 || plan::area(face) < kLeastGround) return face = {}, void();
      const Material kind = work.kinds[f] == FaceKind::paved ? Material::pavement : work.ground;
      bool mended = false;
      for (const Polygon& part : geos_.valid_polygons(face, mended)) pieces[kind].push_back(geos_.polygon(part));
      face = {};
    };
    std::uint32_t open = 0;
    each_ring(work.shape, [&](std::uint32_t f, bool outer, std::span<const std::uint32_t> ring) {
      if (outer) flush(open);
      std::vector<Vec2d>& flat = outer ? face.outer : face.holes.emplace_back();
      for (const std::uint32_t c : ring) flat.push_back(Vec2d(work.shape.points[c]));
      open = f;
    });
    flush(open);
    if (pieces.empty()) all_.issues.push_back({work.shape.where, "has no area in plan"});
    for (auto& [kind, parts] : pieces) cover(work.shape, kind, std::move(parts));
  }

  void cover(const ConstructionFeature& work, Material kind, std::vector<Geometry> parts) {
    const Geometry all = geos_.collection(GEOS_MULTIPOLYGON, std::move(parts));
    const Geometry one = geos_.owned(all ? GEOSUnaryUnion_r(geos_.handle(), all.get()) : nullptr);
    if (!one) all_.issues.push_back({work.where, "its surfaces could not be joined; drawn one by one"});
    std::vector<Polygon> shapes = geos_.polygons(one ? one.get() : all.get());
    const bool some = std::ranges::any_of(shapes, [](const Polygon& p) { return plan::area(p) >= kSliver; });
    if (some) std::erase_if(shapes, [](const Polygon& p) { return plan::area(p) < kSliver; });
    for (Polygon& shape : shapes)
      city_.areas.push_back(
          {.where = work.where, .shape = std::move(shape), .kind = kind, .attributes = work.attributes});
  }

  void plant(const StandingTree& tree) {
    const auto at = plan({tree.foot.lat_deg, tree.foot.lon_deg, 0});
    if (at)
      city_.trees.push_back(
          {*at, tree.height, tree.crown_radius, kind_of(tree.species), tree.species, tree.attributes});
  }

  Collected all_;
  CityFeatures city_;
  TerrainHeights terrain_;
  std::unordered_set<std::string> told_;
  const Geos geos_;
};

}  // namespace

CityFeatures features_of(Collected collected) { return Laying(std::move(collected)).run(); }

}  // namespace manzana::cityjson
