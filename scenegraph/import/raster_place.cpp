#include "scenegraph/import/raster_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace manzana {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

OGRSpatialReference system_of(GDALDataset& data, const std::string& otherwise) {
  return data.GetSpatialRef() == nullptr ? spatial_reference(otherwise) : *data.GetSpatialRef();
}

Vec2d applied(const double (&m)[6], const Vec2d& p) {
  return {m[0] + m[1] * p.x + m[2] * p.y, m[3] + m[4] * p.x + m[5] * p.y};
}

}  // namespace

RasterPlace::RasterPlace(GDALDataset& data, const std::string& otherwise)
    : from_degrees_(system_of(data, otherwise), GeoTransform::Way::from_degrees),
      to_degrees_(system_of(data, otherwise)) {
  if (data.GetGeoTransform(to_place_) != CE_None || GDALInvGeoTransform(to_place_, to_pixel_) == FALSE)
    throw std::runtime_error("does not say where it lies");
}

Vec2d RasterPlace::pixel_of(const LocalFrame& frame, const Vec2d& plan) const {
  const GeoPoint place = frame.to_geo({plan.x, plan.y, frame.ground_z(plan)});
  double x = place.lon_deg, y = place.lat_deg;
  return from_degrees_.apply(x, y) ? applied(to_pixel_, {x, y}) : Vec2d(kNowhere);
}

Vec2d RasterPlace::plan_of(const LocalFrame& frame, const Vec2d& pixel) const {
  Vec2d p = applied(to_place_, pixel);
  const bool known = to_degrees_.apply(p.x, p.y);
  const GeoPoint place{p.y, p.x, 0};
  return known && valid(place) && std::abs(p.x) <= 540 ? Vec2d(frame.to_local(place)) : Vec2d(kNowhere);
}

double RasterPlace::pixel_size(const LocalFrame& frame, const Vec2d& plan) const {
  const Vec2d at = pixel_of(frame, plan);
  const double east = glm::distance(at, pixel_of(frame, plan + Vec2d(100, 0))),
               north = glm::distance(at, pixel_of(frame, plan + Vec2d(0, 100)));
  const double size = 100 / std::max(east, north);
  if (!std::isfinite(size)) throw std::runtime_error("does not reach the city");
  return size;
}

}  // namespace manzana
