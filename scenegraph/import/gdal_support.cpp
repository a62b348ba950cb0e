#include "scenegraph/import/gdal_support.h"

#include <cmath>
#include <mutex>
#include <stdexcept>

namespace manzana {
namespace {

std::string last_message(const std::string& otherwise) {
  const std::string text = CPLGetLastErrorMsg();
  return text.empty() ? otherwise : text.substr(0, text.find('\n'));
}

}  // namespace

GdalSilence::GdalSilence() {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLErrorReset();
}

GdalSilence::~GdalSilence() { CPLPopErrorHandler(); }

GdalFile::GdalFile(const std::filesystem::path& file, unsigned flags, const std::vector<const char*>& drivers) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw std::runtime_error("no such file");
  std::vector<const char*> allowed = drivers;
  allowed.push_back(nullptr);
  dataset_.reset(GDALDataset::Open(file.c_str(), flags | GDAL_OF_READONLY, allowed.data()));
  if (!dataset_) throw std::runtime_error("cannot be read: " + last_message("of no kind that is known"));
}

OGRSpatialReference spatial_reference(const std::string& name) {
  const GdalSilence silence;
  OGRSpatialReference system;
  if (system.SetFromUserInput(name.empty() ? "EPSG:4326" : name.c_str(),
                              OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) != OGRERR_NONE)
    throw std::runtime_error("reference system " + name + ": " + last_message("is not known"));
  return system;
}

GeoTransform::GeoTransform(OGRSpatialReference system, Way way) {
  const GdalSilence silence;
  OGRSpatialReference degrees = spatial_reference("");
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  transform_.reset(way == Way::to_degrees ? OGRCreateCoordinateTransformation(&system, &degrees)
                                          : OGRCreateCoordinateTransformation(&degrees, &system));
  if (!transform_) throw std::runtime_error("its reference system: " + last_message("is not known"));
}

bool GeoTransform::apply(OGRGeometry& geometry) const {
  const GdalSilence silence;
  if (geometry.transform(transform_.get()) != OGRERR_NONE) return false;
  OGREnvelope box;
  geometry.getEnvelope(&box);
  return std::abs(box.MinX) <= 540 && std::abs(box.MaxX) <= 540 && box.MinY >= -90 && box.MaxY <= 90;
}

bool GeoTransform::apply(double& x, double& y) const {
  const GdalSilence silence;
  return transform_->Transform(1, &x, &y) != FALSE && std::isfinite(x) && std::isfinite(y);
}

}  // namespace manzana
