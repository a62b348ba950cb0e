#include "tests/import/gis/made_picture.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

namespace manzana {
namespace {

OGRSpatialReference named(const std::string& system) {
  OGRSpatialReference s;
  s.SetFromUserInput(system.c_str());
  s.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return s;
}

using Transform = std::unique_ptr<OGRCoordinateTransformation>;
Transform between(const std::string& from, const std::string& to) {
  const OGRSpatialReference a = named(from), b = named(to);
  return Transform(OGRCreateCoordinateTransformation(&a, &b));
}

}  // namespace

void write_picture(const std::filesystem::path& file, const MadePicture& picture, const std::string& system,
                   const ColourAt& colour) {
  GDALAllRegister();
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  const std::unique_ptr<GDALDataset> data(
      memory->Create("", picture.width, picture.height, picture.bands, GDT_Byte, nullptr));
  std::array<double, 6> m = picture.to_place;
  if (m != std::array<double, 6>{}) data->SetGeoTransform(m.data());
  if (!picture.system.empty()) {
    const OGRSpatialReference s = named(picture.system);
    data->SetSpatialRef(&s);
  }
  const Transform to_degrees = between(system, "EPSG:4326");
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      double px = m[0] + m[1] * (x + 0.5) + m[2] * (y + 0.5), py = m[3] + m[4] * (x + 0.5) + m[5] * (y + 0.5);
      to_degrees->Transform(1, &px, &py);
      const std::array<int, 4> c = colour({py, px, 0});
      for (int b = 0; b < picture.bands; ++b) {
        auto value = static_cast<GByte>(c[static_cast<std::size_t>(b)]);
        if (data->GetRasterBand(b + 1)->RasterIO(GF_Write, x, y, 1, 1, &value, 1, 1, GDT_Byte, 0, 0) != CE_None)
          throw std::runtime_error("a pixel was not written");
      }
    }
  if (picture.bands == 4) data->GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand);
  if (picture.void_value >= 0) data->GetRasterBand(1)->SetNoDataValue(picture.void_value);
  CPLStringList options;
  if (picture.driver != "GTiff") options.SetNameValue("WORLDFILE", "YES");
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(picture.driver.c_str());
  GDALClose(driver->CreateCopy(file.c_str(), data.get(), FALSE, options.List(), nullptr, nullptr));
}

std::array<double, 6> placed_at(const GeoPoint& middle, const std::string& system, double metres, double turned_deg,
                                const MadePicture& picture) {
  GDALAllRegister();
  double x = middle.lon_deg, y = middle.lat_deg;
  between("EPSG:4326", system)->Transform(1, &x, &y);
  const double turn = turned_deg / 57.29577951308232, c = metres * std::cos(turn), s = metres * std::sin(turn);
  const double half_x = picture.width / 2.0, half_y = picture.height / 2.0;
  return {x - c * half_x - s * half_y, c, s, y - s * half_x + c * half_y, s, -c};
}

}  // namespace manzana
