#include <cmath>
#include <unordered_map>

#include "scenegraph/import/import.h"

namespace manzana {
namespace {

constexpr double kReach = 300e3;  // metres from the frame's anchor; what lies farther is a stray

/// From one frame's plan into another's.
struct Move {
  const LocalFrame& from;
  const LocalFrame& to;
  std::size_t far = 0;

  Vec2d operator()(const Vec2d& p) const {
    const GeoPoint place = from.to_geo({p, from.ground_z(p)});
    return Vec2d(to.to_local({place.lat_deg, place.lon_deg, 0}));
  }
  void all(std::vector<Vec2d>& points) const {
    for (Vec2d& p : points) p = (*this)(p);
  }
  void all(Polygon& shape) const {
    all(shape.outer);
    for (auto& hole : shape.holes) all(hole);
  }
  bool near(const Vec2d& p) { return glm::length(p) <= kReach || (++far, false); }
  bool near(const std::vector<Vec2d>& points) { return points.empty() || near(points[0]); }
};

/// Nodes of two sources have nothing to do with each other, whatever their numbers are.
struct Renumber {
  std::int64_t next = 0;
  std::unordered_map<std::int64_t, std::int64_t> known = {};
  std::int64_t all(std::vector<StreetFeature>& streets) {
    for (StreetFeature& street : streets)
      for (std::int64_t& node : street.nodes) {
        const auto [at, fresh] = known.try_emplace(node, next);
        if (fresh) ++next;
        node = at->second;
      }
    return next;
  }
};

template <class T>
void append(std::vector<T>& to, std::vector<T>&& from, auto&& keep) {
  for (T& item : from)
    if (keep(item)) to.push_back(std::move(item));
}

}  // namespace

void merge(CityFeatures& into, CityFeatures more) {
  Move move{more.frame, into.frame};
  const auto said = [&](auto& feature) {
    feature.attributes = into.attributes.row(more.attributes.table().row(feature.attributes));
  };
  append(into.buildings, std::move(more.buildings),
         [&](BuildingFeature& b) { return said(b), move.all(b.footprint), move.near(b.footprint.outer); });
  const std::uint32_t textures = join(into.pictures, std::move(more.pictures));
  append(into.constructions, std::move(more.constructions), [&](ConstructionFeature& c) {
    said(c);
    for (ConstructionFeature::Face& face : c.faces) face.texture += face.texture > 0 ? textures : 0;
    for (Vec3d& p : c.points) p = {move(Vec2d(p)), p.z};
    return c.points.empty() || move.near(Vec2d(c.points[0]));
  });
  Renumber own;
  Renumber other{.next = own.all(into.streets)};
  other.all(more.streets);
  append(into.streets, std::move(more.streets),
         [&](StreetFeature& s) { return said(s), move.all(s.line), move.near(s.line); });
  append(into.trees, std::move(more.trees),
         [&](TreeFeature& t) { return said(t), move.near(t.position = move(t.position)); });
  append(into.plants, std::move(more.plants), [&](PlacedPlant& p) {
    p.position = {move(Vec2d(p.position)), p.position.z};
    return move.near(Vec2d(p.position));
  });
  append(into.areas, std::move(more.areas),
         [&](AreaFeature& a) { return said(a), move.all(a.shape), move.near(a.shape.outer); });
  append(into.issues, std::move(more.issues), [](const Issue&) { return true; });
  if (move.far > 0)
    into.issues.push_back(
        {"another source", std::to_string(move.far) + " features are farther than 300 km from the first; left out"});
  if (!more.attribution.empty() && into.attribution != more.attribution)
    into.attribution += (into.attribution.empty() ? "" : "; ") + more.attribution;
}

}  // namespace manzana
