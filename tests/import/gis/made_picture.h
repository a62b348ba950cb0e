#pragma once
/// Pictures whose pixels are known by their places on the Earth, written by GDAL.
#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "scenegraph/local_frame.h"

namespace manzana {

struct MadePicture {
  std::string driver = "GTiff", system = {};  ///< EPSG:32633; empty: the file names none
  std::array<double, 6> to_place{};           ///< GDAL's geotransform; all 0: it is not told
  int width = 300, height = 200, bands = 3;
  double void_value = -1;  ///< of no data; negative: none
};

using ColourAt = std::function<std::array<int, 4>(const GeoPoint&)>;

/// Each pixel has the colour of its middle. `system`: what the pixels' places are in.
void write_picture(const std::filesystem::path& file, const MadePicture& picture, const std::string& system,
                   const ColourAt& colour);

/// Of a picture in metres whose middle is at that place; turned by so many degrees.
std::array<double, 6> placed_at(const GeoPoint& middle, const std::string& system, double metres, double turned_deg,
                                const MadePicture& picture);

}  // namespace manzana
