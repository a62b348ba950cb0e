#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scenegraph/import/surface_piece.h"

namespace manzana {
namespace {

constexpr double kUvPeriod = 1200;  // metres: uv starts anew there, so that floats stay exact
constexpr double kLeastArea = 0.5;  // m2
constexpr double kFarthest = 1e7;   // metres from the anchor: more than a quadrant of the Earth is a mistake

struct Box2 {
  Vec2d low{0, 0}, high{0, 0};
};

Box2 box_of(const plan::Ring& ring) {
  Box2 box{ring[0], ring[0]};
  for (const Vec2d& p : ring) box = {glm::min(box.low, p), glm::max(box.high, p)};
  return box;
}

Polygon moved(const Polygon& shape, const Vec2d& by) {
  Polygon result = shape;
  for (Vec2d& p : result.outer) p += by;
  for (plan::Ring& hole : result.holes)
    for (Vec2d& p : hole) p += by;
  return result;
}

bool usable(const Polygon& shape) {
  const auto near = [](const plan::Ring& ring) {
    return plan::finite(ring) && std::all_of(ring.begin(), ring.end(), [](const Vec2d& p) {
             return std::max(std::abs(p.x), std::abs(p.y)) <= kFarthest;
           });
  };
  return shape.outer.size() >= 3 && near(shape.outer) && std::all_of(shape.holes.begin(), shape.holes.end(), near);
}

int cells_along(double extent) {
  return static_cast<int>(std::clamp(std::ceil(extent / kSurfacePiece), 1.0, double{kMostCells}));
}

/// Cuts one mended polygon by halves, down to single cells.
class Cutter {
 public:
  Cutter(std::vector<SurfacePiece>& pieces, const Geos& geos, const Vec2d& origin, const AreaCover& cover)
      : pieces_(pieces), geos_(geos), origin_(origin), cover_(cover) {}

  /// False when a part could not be triangulated.
  bool run(const Polygon& shape) {
    box_ = box_of(shape.outer);
    const Vec2d extent = box_.high - box_.low;
    nx_ = cells_along(extent.x);
    ny_ = cells_along(extent.y);
    const Geometry g = geos_.polygon(shape);
    if (g) cut(g.get(), {0, 0, nx_, ny_});
    return g && whole_;
  }

 private:
  struct Cells {
    int x0, y0, x1, y1;
  };
  Vec2d corner(int x, int y) const {
    return box_.low + (box_.high - box_.low) * Vec2d{x / double(nx_), y / double(ny_)};
  }

  Geometry part(const GEOSGeometry* g, const Cells& c) const {
    const Vec2d a = corner(c.x0, c.y0), b = corner(c.x1, c.y1);
    Geometry quick = geos_.owned(GEOSClipByRect_r(geos_.handle(), g, a.x, a.y, b.x, b.y));
    if (quick && GEOSisValid_r(geos_.handle(), quick.get()) == 1) return quick;
    const Geometry rectangle = geos_.polygon({{a, {b.x, a.y}, b, {a.x, b.y}}, {}});
    return geos_.owned(GEOSIntersection_r(geos_.handle(), g, rectangle.get()));
  }

  void cut(const GEOSGeometry* g, const Cells& c) {
    if (GEOSisEmpty_r(geos_.handle(), g) == 1) return;
    const int wide = c.x1 - c.x0, high = c.y1 - c.y0;
    if (wide == 1 && high == 1) return lay(g);
    Cells one = c, other = c;
    if (wide >= high) {
      one.x1 = other.x0 = c.x0 + wide / 2;
    } else {
      one.y1 = other.y0 = c.y0 + high / 2;
    }
    for (const Cells& half : {one, other})
      if (const Geometry piece = part(g, half)) {
        cut(piece.get(), half);
      } else {
        whole_ = false;
      }
  }

  void lay(const GEOSGeometry* g) {
    std::vector<plan::Triangle> triangles;
    for (const Polygon& p : geos_.polygons(g)) {
      const std::vector<plan::Triangle> t = plan::triangulate(geos_, p);
      whole_ = whole_ && (!t.empty() || plan::area(p) < kLeastArea);
      triangles.insert(triangles.end(), t.begin(), t.end());
    }
    if (!triangles.empty()) emit(triangles);
  }

  static Vec2d center(const std::vector<plan::Triangle>& triangles) {
    Vec2d sum{0, 0};
    double weight = 0;
    for (const auto& [a, b, c] : triangles) {
      sum += plan::turn(a, b, c) * (a + b + c) / 3.0;
      weight += plan::turn(a, b, c);
    }
    return sum / weight;
  }

  void emit(const std::vector<plan::Triangle>& triangles) {
    PieceBuilder piece(origin_ + center(triangles));
    const std::uint32_t colour = ground_colour(cover_.material);
    std::map<std::array<double, 2>, std::uint32_t> rows;
    const auto row = [&](const Vec2d& p) {
      const auto [at, fresh] = rows.try_emplace({p.x, p.y}, 0);
      if (fresh) at->second = piece.vertex({origin_ + p, cover_.height}, {0, 0, 1}, colour, p);
      return at->second;
    };
    for (const plan::Triangle& t : triangles) piece.triangle(row(t[0]), row(t[1]), row(t[2]));
    pieces_.push_back(piece.take());
  }

  std::vector<SurfacePiece>& pieces_;
  const Geos& geos_;
  Vec2d origin_;
  const AreaCover& cover_;
  Box2 box_;
  int nx_ = 1, ny_ = 1;
  bool whole_ = true;
};

std::uint32_t ground_rgb(Material material) {
  switch (material) {
    case Material::asphalt:
    case Material::junction:
      return 0x56575a;
    case Material::pavement:
      return 0xa8a39a;
    case Material::path:
      return 0xb5a68a;
    case Material::park:
      return 0x7fa562;
    case Material::wood:
      return 0x5d6b42;
    case Material::farmland:
      return 0xb9ad74;
    case Material::sand:
      return 0xd9cba0;
    case Material::water:
      return 0x4f7d99;
    case Material::concrete:
      return 0xb4b2ab;
    default:
      return 0x86a85a;  // grass
  }
}

}  // namespace

std::uint32_t ground_colour(Material material) { return pack_colour(ground_rgb(material), material); }

double area_height(Material kind) {
  constexpr std::array kOrder{Material::concrete, Material::wood, Material::farmland, Material::grass,
                              Material::park,     Material::sand, Material::water,    Material::pavement};
  const auto rank = std::find(kOrder.begin(), kOrder.end(), kind) - kOrder.begin();
  return 0.015 + 0.005 * static_cast<double>(rank);
}

std::uint32_t PieceBuilder::vertex(const Vec3d& position, const Vec3d& normal, std::uint32_t colour, const Vec2d& uv) {
  const Vec3 relative(position - Vec3d(piece_.center, 0));
  piece_.plan.vertices.push_back({relative, pack_normal(Vec3(glm::normalize(normal))), colour, Vec2(uv), 0});
  return static_cast<std::uint32_t>(piece_.plan.vertices.size() - 1);
}

void PieceBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  piece_.plan.indices.insert(piece_.plan.indices.end(), {a, b, c});
}

void append_area(std::vector<SurfacePiece>& pieces, const Geos& geos, const Polygon& shape, const AreaCover& cover,
                 std::vector<Issue>& issues) {
  if (!usable(shape)) return issues.push_back({cover.where, "an outline of fewer than three points, or not finite"});
  const Vec2d origin = glm::floor(shape.outer[0] / kUvPeriod) * kUvPeriod;
  bool mended = false, whole = true;
  double laid = 0;
  for (const Polygon& part : geos.valid_polygons(moved(shape, -origin), mended)) {
    if (plan::area(part) < kLeastArea) continue;
    laid += plan::area(part);
    whole = Cutter(pieces, geos, origin, cover).run(part) && whole;
  }
  if (laid == 0) return issues.push_back({cover.where, "an outline without area"});
  if (mended) issues.push_back({cover.where, "the outline crosses itself; mended"});
  if (!whole) issues.push_back({cover.where, "a part of the area could not be triangulated"});
}

std::vector<SurfacePiece> area_pieces(std::span<const AreaFeature> areas, std::vector<Issue>& issues) {
  const Geos geos;
  std::vector<SurfacePiece> pieces;
  for (const AreaFeature& area : areas) {
    const std::size_t first = pieces.size();
    append_area(pieces, geos, area.shape, {area.where, area.kind, area_height(area.kind)}, issues);
    for (std::size_t i = first; i < pieces.size(); ++i) pieces[i].attributes = area.attributes;
  }
  return pieces;
}

}  // namespace manzana
