#include "scenegraph/import/geos.h"

#include <algorithm>
#include <cmath>

namespace manzana {
namespace {

bool finite(std::span<const Vec2d> points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Vec2d& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

GEOSCoordSequence* sequence(GEOSContextHandle_t handle, std::span<const Vec2d> points, bool close) {
  std::vector<double> xy;
  xy.reserve(2 * points.size() + 2);
  for (const Vec2d& p : points) xy.insert(xy.end(), {p.x, p.y});
  if (close) xy.insert(xy.end(), {points[0].x, points[0].y});
  return GEOSCoordSeq_copyFromBuffer_r(handle, xy.data(), static_cast<unsigned>(xy.size() / 2), 0, 0);
}

GEOSGeometry* ring(GEOSContextHandle_t handle, std::span<const Vec2d> points) {
  if (points.size() < 3 || !finite(points)) return nullptr;
  return GEOSGeom_createLinearRing_r(handle, sequence(handle, points, true));
}

void silent(const char*, void*) {}

}  // namespace

Geos::Geos() : handle_(GEOS_init_r()) {
  GEOSContext_setNoticeMessageHandler_r(handle_, silent, nullptr);
  GEOSContext_setErrorMessageHandler_r(handle_, silent, nullptr);
}
Geos::~Geos() { GEOS_finish_r(handle_); }

Geometry Geos::line(std::span<const Vec2d> points) const {
  if (points.size() < 2 || !finite(points)) return owned(nullptr);
  return owned(GEOSGeom_createLineString_r(handle_, sequence(handle_, points, false)));
}

Geometry Geos::polygon(const Polygon& shape) const {
  GEOSGeometry* outer = ring(handle_, shape.outer);
  if (outer == nullptr) return owned(nullptr);
  std::vector<GEOSGeometry*> holes;
  for (const auto& hole : shape.holes)
    if (GEOSGeometry* h = ring(handle_, hole)) holes.push_back(h);
  return owned(GEOSGeom_createPolygon_r(handle_, outer, holes.data(), static_cast<unsigned>(holes.size())));
}

Geometry Geos::collection(int type, std::vector<Geometry> members) const {
  std::vector<GEOSGeometry*> raw;
  raw.reserve(members.size());
  for (Geometry& g : members) raw.push_back(g.release());
  return owned(GEOSGeom_createCollection_r(handle_, type, raw.data(), static_cast<unsigned>(raw.size())));
}

std::vector<Vec2d> Geos::points(const GEOSGeometry* g) const {
  const GEOSCoordSequence* s = GEOSGeom_getCoordSeq_r(handle_, g);
  unsigned n = 0;
  if (s == nullptr || GEOSCoordSeq_getSize_r(handle_, s, &n) == 0) return {};
  std::vector<Vec2d> result(n);
  for (unsigned i = 0; i < n; ++i) GEOSCoordSeq_getXY_r(handle_, s, i, &result[i].x, &result[i].y);
  if (n > 1 && GEOSGeomTypeId_r(handle_, g) == GEOS_LINEARRING) result.pop_back();
  return result;
}

std::vector<Polygon> Geos::polygons(const GEOSGeometry* g) const {
  std::vector<Polygon> result;
  if (g == nullptr || GEOSisEmpty_r(handle_, g) != 0) return result;
  if (GEOSGeomTypeId_r(handle_, g) == GEOS_POLYGON) {
    Polygon p{points(GEOSGetExteriorRing_r(handle_, g)), {}};
    for (int i = 0; i < GEOSGetNumInteriorRings_r(handle_, g); ++i)
      p.holes.push_back(points(GEOSGetInteriorRingN_r(handle_, g, i)));
    result.push_back(std::move(p));
  } else if (GEOSGeomTypeId_r(handle_, g) >= GEOS_MULTIPOINT) {
    for (int i = 0; i < GEOSGetNumGeometries_r(handle_, g); ++i)
      for (Polygon& p : polygons(GEOSGetGeometryN_r(handle_, g, i))) result.push_back(std::move(p));
  }
  return result;
}

std::vector<Polygon> Geos::valid_polygons(const Polygon& shape, bool& mended) const {
  mended = false;
  Geometry g = polygon(shape);
  if (!g) return {};
  if (GEOSisValid_r(handle_, g.get()) != 1) {
    mended = true;
    g = owned(GEOSMakeValid_r(handle_, g.get()));
  }
  return polygons(g.get());
}

}  // namespace manzana
