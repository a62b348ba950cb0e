#pragma once
/// From the coordinates of a file to places on the Earth.
///   ReferenceSystem system("https://www.opengis.net/def/crs/EPSG/0/7415");
///   std::optional<GeoPoint> place = system.to_geo({85'012.3, 446'512.7, 4.2});
/// Coordinates come as x, y: easting before northing, longitude before latitude, whatever the system's own order says.
/// Of a compound system the horizontal part places a point; heights stay as the file has them, in metres. By PROJ,
/// without its network; in a build without PROJ only WGS 84 is known (EPSG:4326, EPSG:4979, CRS84).
#include <memory>
#include <optional>
#include <string>

#include "scenegraph/local_frame.h"

namespace manzana {

class ReferenceSystem {
 public:
  /// "EPSG:28992", urn:ogc:def:crs:EPSG::28992, a URL of OGC; empty: none, metres about the first point, which comes to
  /// lie at latitude 0, longitude 0. Throws std::runtime_error ("reference system EPSG:9: what").
  explicit ReferenceSystem(const std::string& name);
  ~ReferenceSystem();
  ReferenceSystem(ReferenceSystem&&) noexcept;
  ReferenceSystem& operator=(ReferenceSystem&&) noexcept;

  /// Height: that of the file, in metres. None where the system does not hold.
  std::optional<GeoPoint> to_geo(const Vec3d& xyz);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// "EPSG:28992" of any of the names above; as it is where no authority is found in it. Empty stays empty.
std::string short_name(const std::string& reference_system);

}  // namespace manzana
