#pragma once
/// Orthophotos, by GDAL: GeoTIFF; PNG and JPEG with a world file.
#include <filesystem>
#include <string>

#include "culling/volumes.h"
#include "scenegraph/ground_photo.h"
#include "scenegraph/local_frame.h"

namespace manzana {

/// What the file has of the city's box and some way beyond, as fine as it is, but at most 8192 squares a side.
/// `reference_system`: of a file that names none; empty: WGS 84. Throws std::runtime_error ("FILE: what"): among others
/// where the file does not reach the city, or the build is without GDAL.
GroundPhoto read_ground_photo(const std::filesystem::path& file, const LocalFrame& frame, const culling::BoxD& city,
                              const std::string& reference_system);

}  // namespace manzana
