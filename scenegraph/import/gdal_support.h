#pragma once
/// GDAL with owners, without its network and its messages; only in builds that have it.
///   const GdalFile dataset(file, GDAL_OF_VECTOR, {"GPKG"});
///   const GeoTransform to_degrees(spatial_reference("EPSG:28992"));
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace manzana {

/// On its thread, as long as it lives, GDAL's messages go nowhere; the last one is kept.
class GdalSilence {
 public:
  GdalSilence();
  ~GdalSilence();
  GdalSilence(const GdalSilence&) = delete;
  GdalSilence& operator=(const GdalSilence&) = delete;
};

/// A file's messages may come as late as its bytes are read.
class GdalFile {
 public:
  /// A regular file, by one of those drivers. Throws std::runtime_error without the file's name.
  GdalFile(const std::filesystem::path& file, unsigned flags, const std::vector<const char*>& drivers);
  GDALDataset& operator*() const { return *dataset_; }
  GDALDataset* operator->() const { return dataset_.get(); }

 private:
  struct Close {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
  };
  GdalSilence silence_;
  std::unique_ptr<GDALDataset, Close> dataset_;
};

/// Empty: WGS 84. x is easting or longitude. Throws std::runtime_error.
OGRSpatialReference spatial_reference(const std::string& name);

/// To longitude and latitude of WGS 84, or from there.
class GeoTransform {
 public:
  enum class Way { to_degrees, from_degrees };
  explicit GeoTransform(OGRSpatialReference system, Way way = Way::to_degrees);
  /// False where it does not hold.
  bool apply(OGRGeometry& geometry) const;
  bool apply(double& x, double& y) const;

 private:
  struct Destroy {
    void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
  };
  std::unique_ptr<OGRCoordinateTransformation, Destroy> transform_;
};

}  // namespace manzana
