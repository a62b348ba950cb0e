// Places that others give for points of well-known systems.
#include <catch2/catch.hpp>

#include "scenegraph/import/reference_system.h"

using namespace manzana;

namespace {
struct Known {
  const char* name;
  Vec3d xyz;
  double lat, lon, margin;
};
}  // namespace

TEST_CASE("reference systems place their points") {
  // clang-format off
  const auto known = GENERATE(
      Known{"EPSG:4326", {4.36, 52.01, 5}, 52.01, 4.36, 1e-12},
      Known{"urn:ogc:def:crs:OGC:1.3:CRS84", {4.36, 52.01, 5}, 52.01, 4.36, 1e-12},
      Known{"EPSG:3857", {20037508.342789244, 0, 0}, 0, 180, 1e-9},
      Known{"EPSG:25832", {500000, 0, 0}, 0, 9, 1e-9},
      Known{"https://www.opengis.net/def/crs/EPSG/0/28992", {155000, 463000, 0}, 52.15517, 5.38721, 2e-5},
      Known{"urn:ogc:def:crs:EPSG::7415", {155000, 463000, 12}, 52.15517, 5.38721, 2e-5},
      Known{"EPSG:7415", {84616.47, 447423.00, 0}, 52.0107, 4.3620, 6e-5},  // corners of the manifest's extents
      Known{"EPSG:7415", {196592.37, 424074.41, 0}, 51.8038, 5.9902, 6e-5},
      Known{"EPSG:28992", {91002.42, 436048.22, 0}, 51.9092, 4.4571, 6e-5},
      Known{"EPSG:25833", {396800.54, 5819401.04, 0}, 52.5149, 13.4792, 6e-5},
      Known{"epsg:2056", {2600000, 1200000, 0}, 46.95108, 7.43864, 2e-5},
      Known{"http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/28992&2=http://www.opengis.net/def/crs/EPSG/0/5709",
            {155000, 463000, 0}, 52.15517, 5.38721, 2e-5});
  // clang-format on
  CAPTURE(known.name);
  ReferenceSystem system(known.name);
  const auto place = system.to_geo(known.xyz);
  REQUIRE(place);
  CHECK(place->lat_deg == Approx(known.lat).margin(known.margin));
  CHECK(place->lon_deg == Approx(known.lon).margin(known.margin));
  CHECK(place->height_m == known.xyz.z);
}

TEST_CASE("without a reference system distances stay") {
  ReferenceSystem system("");
  const auto a = system.to_geo({90454.2, 435614.9, 0}), b = system.to_geo({91002.4, 436048.2, 0});
  REQUIRE(a);
  REQUIRE(b);
  CHECK(a->lat_deg == Approx(0).margin(1e-12));
  const LocalFrame frame(*a);
  CHECK(glm::length(frame.to_local(*b)) == Approx(std::hypot(548.2, 433.3)).epsilon(1e-6));
}

TEST_CASE("names that are no codes are refused") {
  for (const char* name : {"EPSG:999999", "+init=/etc/passwd", "+proj=utm +zone=32", "EPSG:28992x", "nowhere",
                           "EPSG:", "file:/etc/passwd", "ESRI:99"}) {
    CAPTURE(name);
    CHECK_THROWS_WITH(ReferenceSystem(name), Catch::StartsWith("reference system "));
  }
}

TEST_CASE("coordinates beyond a system are no places") {
  ReferenceSystem wgs84("EPSG:4326"), utm("EPSG:25832");
  CHECK_FALSE(wgs84.to_geo({0, 91, 0}));
  CHECK_FALSE(wgs84.to_geo({1e300, 0, 0}));
  CHECK_FALSE(utm.to_geo({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  CHECK_FALSE(utm.to_geo({500000, 1e12, 0}));
}
