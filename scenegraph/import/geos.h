#pragma once
/// GEOS through its C API, with owners. One Geos per thread and task; geometries must not outlive it.
///   Geos geos;
///   Geometry face = geos.polygon(shape);                 // empty owner when GEOS refuses
///   Geometry mended = geos.owned(GEOSMakeValid_r(geos.handle(), face.get()));
/// Only the C API's reentrant functions; plan coordinates in metres (in degrees its triangulation fails).
#include <geos_c.h>

#include <memory>
#include <span>
#include <vector>

#include "scenegraph/import/features.h"

namespace manzana {

struct GeometryDeleter {
  GEOSContextHandle_t handle = nullptr;
  void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(handle, g); }
};
using Geometry = std::unique_ptr<GEOSGeometry, GeometryDeleter>;

class Geos {
 public:
  Geos();  ///< messages of GEOS are dropped: a null result says enough
  ~Geos();
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  GEOSContextHandle_t handle() const { return handle_; }
  Geometry owned(GEOSGeometry* g) const { return Geometry(g, GeometryDeleter{handle_}); }

  /// Null when GEOS refuses: fewer than two (line) or three (ring) points, or a coordinate that is not finite.
  Geometry line(std::span<const Vec2d> points) const;
  Geometry polygon(const Polygon& shape) const;
  /// Takes the members over. `type` is a GEOS_MULTI... or GEOS_GEOMETRYCOLLECTION.
  Geometry collection(int type, std::vector<Geometry> members) const;

  /// The polygons in a geometry of any type, as open rings; lines and points in it are passed over.
  std::vector<Polygon> polygons(const GEOSGeometry* g) const;
  std::vector<Vec2d> points(const GEOSGeometry* line_or_ring) const;
  /// Mended by MakeValid where it is not valid; `mended` says so. Empty when nothing with an area is left.
  std::vector<Polygon> valid_polygons(const Polygon& shape, bool& mended) const;

 private:
  GEOSContextHandle_t handle_;
};

}  // namespace manzana
