// Poisson disks: apart as told, spread from the first few on, and always at an end (numerics.md 12.3).
#include "foliage/poisson_disk.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace manzana::foliage {
namespace {

using Triangle = std::array<Vec3d, 3>;

// A unit square, bent along its diagonal, and a splinter beside it.
const std::vector<Triangle> kSurface{
    {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{1, 1, .2}},
    {Vec3d{0, 0, 0}, Vec3d{1, 1, .2}, Vec3d{0, 1, .1}},
    {Vec3d{2, 0, 0}, Vec3d{2, 1, 0}, Vec3d{2, 1, 1e-6}},
};

Vec3d position(std::span<const Triangle> triangles, const SurfacePoint& p) {
  const Triangle& t = triangles[p.triangle];
  return t[0] + (t[1] - t[0]) * p.place.x + (t[2] - t[0]) * p.place.y;
}

double least_distance(std::span<const Triangle> triangles, std::span<const SurfacePoint> points) {
  double least = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      least = std::min(least, glm::distance(position(triangles, points[i]), position(triangles, points[k])));
  return least;
}

}  // namespace

TEST_CASE("disks of a least distance are apart by it") {
  for (const double r : {0.03, 0.1, 0.3}) {
    const auto points = poisson_disk(kSurface, {.count = 100'000, .least_distance = r});
    CHECK(least_distance(kSurface, points) >= r * (1 - 4 * 0x1p-53));
    CHECK(static_cast<double>(points.size()) <= 1 + 0.7 * 1.03 / (r * r));
    CHECK(static_cast<double>(points.size()) >= 0.4 / (r * r));  // thrown to the end it were 0.7
    for (const SurfacePoint& p : points) {
      CHECK(p.triangle < 3);
      CHECK((p.place.x >= 0 && p.place.y >= 0 && p.place.x + p.place.y <= 1));
    }
  }
}

TEST_CASE("any first few disks are spread") {
  const auto points = poisson_disk(kSurface, {.count = 1024, .seed = 3});
  REQUIRE(points.size() == 1024);
  for (const std::size_t m : {2U, 5U, 16U, 64U, 200U, 1024U})
    CHECK(least_distance(kSurface, std::span(points).first(m)) >= 0.45 * std::sqrt(1.0 / static_cast<double>(m)));
  const auto fewer = poisson_disk(kSurface, {.count = 100, .seed = 3});
  CHECK(std::equal(fewer.begin(), fewer.end(), points.begin(),
                   [](const auto& a, const auto& b) { return a.triangle == b.triangle && a.place == b.place; }));
}

TEST_CASE("disks come to an end on any surface") {
  CHECK(poisson_disk({}, {}).empty());
  CHECK(poisson_disk(kSurface, {.count = 50, .least_distance = 100}).size() == 1);
  CHECK(poisson_disk(kSurface, {.count = 0}).empty());
  const std::vector<Triangle> point{{Vec3d{1, 1, 1}, Vec3d{1, 1, 1}, Vec3d{1, 1, 1}}};
  CHECK(poisson_disk(point, {.count = 10}).size() == 10);
  CHECK(poisson_disk(point, {.count = 10, .least_distance = 0.1}).size() == 1);
}

}  // namespace manzana::foliage
