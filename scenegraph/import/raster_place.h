#pragma once
/// Where a raster of GDAL's lies; only in builds that have it.
///   const RasterPlace place(*dataset, "EPSG:25832");           // of one that names no reference system
///   const Vec2d pixel = place.pixel_of(frame, {120, -35});
#include "scenegraph/import/gdal_support.h"
#include "scenegraph/local_frame.h"

namespace manzana {

/// Pixels count from the outer corner of the first: its middle is (0.5, 0.5).
class RasterPlace {
 public:
  /// Throws std::runtime_error without the file's name, where it does not say where it lies.
  explicit RasterPlace(GDALDataset& data, const std::string& otherwise = {});
  /// Not finite where the reference system does not hold.
  Vec2d pixel_of(const LocalFrame& frame, const Vec2d& plan) const;
  Vec2d plan_of(const LocalFrame& frame, const Vec2d& pixel) const;
  /// Metres of the finer side of a pixel, about that place. Throws std::runtime_error where there are none.
  double pixel_size(const LocalFrame& frame, const Vec2d& plan) const;

 private:
  GeoTransform from_degrees_, to_degrees_;
  double to_place_[6]{}, to_pixel_[6]{};
};

}  // namespace manzana
