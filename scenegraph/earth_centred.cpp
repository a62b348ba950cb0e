#include "scenegraph/earth_centred.h"

#include <GeographicLib/Geocentric.hpp>
#include <vector>

namespace manzana {

Mat4d local_to_ecef(const LocalFrame& frame) {
  const GeoPoint& anchor = frame.anchor();
  std::vector<double> axes(9);
  Vec3d origin;
  GeographicLib::Geocentric::WGS84().Forward(anchor.lat_deg, anchor.lon_deg, anchor.height_m, origin.x, origin.y,
                                             origin.z, axes);
  Mat4d to(1);  // `axes` is row by row: ECEF from east, north, up
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) to[column][row] = axes[static_cast<std::size_t>(3 * row + column)];
  to[3] = Vec4d(origin, 1);
  return to;
}

}  // namespace manzana
